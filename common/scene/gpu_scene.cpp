#include "common/scene/gpu_scene.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <functional>

namespace penumbra {
namespace {

void uploadBuffer(GLenum target, const GlBuffer& buffer, const void* data, std::size_t bytes) {
    glBindBuffer(target, buffer.id());
    glBufferData(target, GLsizeiptr(bytes), data, GL_STATIC_DRAW);
}

void attribute(GLuint location, const GlBuffer& buffer, GLint components) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, 0, nullptr);
}

/// The same triangles in the same order, with all vertices of one position replaced by the first of them: the
/// vertex shader then runs once per position, not once per normal and texture coordinate. Ranges of triangles
/// serve both index buffers.
std::vector<std::uint32_t> depthIndicesOf(const Scene& scene) {
    std::vector<std::uint32_t> indices(scene.indices.size());
    if (!indices.empty())
        meshopt_generateShadowIndexBuffer(indices.data(), scene.indices.data(), scene.indices.size(),
                                          scene.positions.data(), scene.positions.size(), sizeof(glm::vec3),
                                          sizeof(glm::vec3));
    return indices;
}

void uploadTexture(const GlTexture& texture, int width, int height, const std::uint8_t* rgba) {
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    // glTF's v runs down from the top row and OpenGL's first row is v = 0: the rows go up as they are.
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glGenerateMipmap(GL_TEXTURE_2D);
}

void setMaterial(Program& program, const Material& material, GLuint texture) {
    program.set("uDiffuse", material.diffuse);
    program.set("uSpecular", material.specular);
    program.set("uShininess", material.shininess);
    program.set("uEmission", material.emission);
    program.set("uHasTexture", material.diffuseTexture >= 0);
    program.setTexture("uDiffuseTexture", GL_TEXTURE_2D, texture);
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, const Capabilities& capabilities)
    : scene_(&scene), capabilities_(capabilities) {
    glBindVertexArray(0);
    uploadBuffer(GL_ARRAY_BUFFER, positions_, scene.positions.data(),
                 scene.positions.size() * sizeof(glm::vec3));
    uploadBuffer(GL_ARRAY_BUFFER, normals_, scene.normals.data(), scene.normals.size() * sizeof(glm::vec3));
    uploadBuffer(GL_ARRAY_BUFFER, uvs_, scene.uvs.data(), scene.uvs.size() * sizeof(glm::vec2));

    glBindVertexArray(shadedArray_.id());
    attribute(0, positions_, 3);
    attribute(1, normals_, 3);
    attribute(2, uvs_, 2);
    uploadBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_, scene.indices.data(),
                 scene.indices.size() * sizeof(std::uint32_t));

    glBindVertexArray(depthArray_.id());
    attribute(0, positions_, 3);
    const std::vector<std::uint32_t> depthIndices = depthIndicesOf(scene);
    uploadBuffer(GL_ELEMENT_ARRAY_BUFFER, depthIndices_, depthIndices.data(),
                 depthIndices.size() * sizeof(std::uint32_t));
    glBindVertexArray(0);

    const std::uint8_t white[4] = {255, 255, 255, 255};
    uploadTexture(white_, 1, 1, white);
    for (const Texture& texture : scene.textures)
        uploadTexture(textures_.emplace_back(), texture.width, texture.height, texture.rgba.data());
}

DrawCounts GpuScene::drawDepth(const DepthDraw& draw) const {
    DrawCounts counts;
    const auto drawWhere = [&](const std::function<bool(const Part&)>& wanted) {
        drawRanges(joinRanges(*scene_, *draw.visible,
                              [&](std::uint32_t part) {
                                  return int(part) != draw.exceptPart && wanted(scene_->parts[part]);
                              }),
                   counts, draw.instances);
    };
    glBindVertexArray(depthArray_.id());
    if (!draw.cullClosed) {
        drawWhere([](const Part&) { return true; });
        return counts;
    }
    glEnable(GL_CULL_FACE);
    glCullFace(draw.frontFacesInstead ? GL_FRONT : GL_BACK);
    drawWhere([](const Part& part) { return part.closed; });
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    drawWhere([](const Part& part) { return !part.closed; });
    return counts;
}

DrawCounts GpuScene::drawShaded(Program& program, const VisibleClusters& visible) const {
    std::vector<VisibleClusters> byMaterial(scene_->materials.size());
    for (const std::uint32_t cluster : visible.clusters)
        byMaterial[std::size_t(scene_->parts[scene_->clusters[cluster].part].material)].clusters.push_back(
            cluster);

    DrawCounts counts;
    for (std::size_t i = 0; i < byMaterial.size(); ++i) {
        if (!byMaterial[i].clusters.empty())
            drawMaterial(program, int(i),
                         joinRanges(*scene_, byMaterial[i], [](std::uint32_t) { return true; }), counts);
    }
    return counts;
}

DrawCounts GpuScene::drawShaded(Program& program, int part, const std::vector<IndexRange>& ranges) const {
    DrawCounts counts;
    drawMaterial(program, scene_->parts[std::size_t(part)].material, ranges, counts);
    return counts;
}

void GpuScene::drawMaterial(Program& program, int index, const std::vector<IndexRange>& ranges,
                            DrawCounts& counts) const {
    const Material& material = scene_->materials[std::size_t(index)];
    const GlTexture& texture =
        material.diffuseTexture >= 0 ? textures_[std::size_t(material.diffuseTexture)] : white_;
    setMaterial(program, material, texture.id());
    program.prepareToDraw();
    glBindVertexArray(shadedArray_.id());
    drawRanges(ranges, counts);
}

void GpuScene::drawRanges(const std::vector<IndexRange>& ranges, DrawCounts& counts, int instances) const {
    if (ranges.empty()) return;
    std::vector<GLsizei> sizes;
    std::vector<const void*> offsets;
    for (const IndexRange& range : ranges) {
        sizes.push_back(GLsizei(3 * range.triangleCount));
        offsets.push_back(
            reinterpret_cast<const void*>(3 * sizeof(std::uint32_t) * std::size_t(range.firstTriangle)));
        counts.triangles += std::size_t(range.triangleCount) * std::size_t(instances);
    }
    if (capabilities_.multiDraw && instances == 1) {
        glMultiDrawElements(GL_TRIANGLES, sizes.data(), GL_UNSIGNED_INT, offsets.data(),
                            GLsizei(sizes.size()));
        ++counts.drawCalls;
        return;
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (instances == 1)
            glDrawElements(GL_TRIANGLES, sizes[i], GL_UNSIGNED_INT, offsets[i]);
        else
            glDrawElementsInstanced(GL_TRIANGLES, sizes[i], GL_UNSIGNED_INT, offsets[i], instances);
    }
    counts.drawCalls += sizes.size();
}

}  // namespace penumbra
