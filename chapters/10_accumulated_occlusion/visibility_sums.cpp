#include "chapters/10_accumulated_occlusion/visibility_sums.h"

#include <numbers>
#include <utility>

#include "chapters/10_accumulated_occlusion/direction_batches.h"

namespace penumbra {

TexturePair::TexturePair(const glm::ivec2& size) : first_(size, GL_RGBA32F), second_(size, GL_RGBA32F) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, first_.id(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, second_.id(), 0);
    const GLenum targets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, targets);
    requireCompleteFramebuffer("float sums of visibility (RGBA32F cannot be drawn into)");
}

void TexturePair::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, size().x, size().y);
}

void TexturePair::clear() const {
    bind();
    const float zero[4] = {};
    glClearBufferfv(GL_COLOR, 0, zero);
    glClearBufferfv(GL_COLOR, 1, zero);
}

std::vector<glm::vec4> TexturePair::readFirst() const {
    bind();
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    return readTexels(size());
}

namespace {

/// Row `row` of a matrix: what makes one coordinate of (x, y, z, 1).
glm::vec4 rowOf(const glm::dmat4& m, int row) {
    return {glm::dvec4(m[0][row], m[1][row], m[2][row], m[3][row])};
}

void setMaps(Program& program, const SkyMaps& maps, const SkyBatch& batch) {
    std::vector<glm::vec4> across, up, toSky, radiance;
    for (std::size_t i = 0; i < batch.directions.size(); ++i) {
        const LightFrustum& frustum = batch.frusta[i];
        const glm::dvec3& l = batch.directions[i];
        const glm::dmat4 textureFromWorld = frustum.textureFromWorld();
        across.push_back(rowOf(textureFromWorld, 0) * float(maps.mapSize()));
        up.push_back(rowOf(textureFromWorld, 1) * float(maps.mapSize()));
        toSky.emplace_back(glm::vec3(l), float(glm::dot(l, frustum.eye) - frustum.near));
        radiance.emplace_back(glm::vec3(batch.radiances[i]), 0.0f);
    }
    program.set("uAcross", across);
    program.set("uUp", up);
    program.set("uToSky", toSky);
    program.set("uRadiance", radiance);
    program.set("uCount", int(batch.directions.size()));
    program.setTexture("uMaps", GL_TEXTURE_2D_ARRAY, maps.texture());
}

void setBias(Program& program, const SkyMaps& maps, const SkyBatch& batch) {
    const LightFrustum& frustum = batch.frusta.front();  // all are equally large
    const SkyBias& bias = batch.bound;
    const double texelsPerMetre = maps.mapSize() / (2.0 * frustum.halfExtent.x);
    program.set("uDepthPerMetre", float(1.0 / (frustum.far - frustum.near)));
    program.set("uBiasPerSlope", batch.bias * bias.perSlope / float(texelsPerMetre));
    program.set("uBias", batch.bias * bias.constant);
    if (batch.cellTangent <= 0.0) return;
    // A circle halves a disk at 1 / sqrt(2) of its radius.
    program.set("uCell", float(maps.mapSize() * batch.cellTangent * std::numbers::sqrt2 / 2.0));
    program.set("uTiltPerSlope", float(1.0 / (maps.mapSize() * texelsPerMetre)));
}

}  // namespace

VisibilitySums::VisibilitySums()
    : add_("common/fullscreen.vert", "10_accumulated_occlusion/accumulate.frag"),
      resolve_("common/fullscreen.vert", "10_accumulated_occlusion/resolve.frag") {}

void VisibilitySums::clear(const glm::ivec2& size) {
    if (!sums_[0] || sums_[0]->size() != size)
        for (std::optional<TexturePair>& pair : sums_) pair.emplace(size);
    sums_[0]->clear();
}

void VisibilitySums::add(const Receivers& receivers, const SkyMaps& maps, const SkyBatch& added) {
    std::vector<std::string> defines;
    defines.reserve(3);
    defines.emplace_back("BATCH " + std::to_string(batch));
    if (added.countWork) defines.emplace_back("COUNT_WORK");
    if (added.cellTangent > 0.0) defines.emplace_back("SOFT_EDGES");
    Program& program = add_.with(defines);
    setMaps(program, maps, added);
    setBias(program, maps, added);
    const DirectionCone cone = added.skip ? coneAround(added.directions) : DirectionCone{};
    program.set("uCone", glm::vec4(cone.axis, cone.below));
    program.setTexture("uPositions", GL_TEXTURE_2D, receivers.positions());
    program.setTexture("uNormals", GL_TEXTURE_2D, receivers.normals());
    program.setTexture("uFacets", GL_TEXTURE_2D, receivers.facets());
    program.setTexture("uSeen", GL_TEXTURE_2D, sums_[0]->first());
    program.setTexture("uReceived", GL_TEXTURE_2D, sums_[0]->second());
    program.prepareToDraw();
    // [begin:ping-pong]
    // The new sums go into the other pair of textures: no blending of floats is needed, which not every
    // OpenGL ES can do, and the sums are those of one long loop, to the bit, however the maps are cut into
    // batches.
    sums_[1]->bind();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
    std::swap(sums_[0], sums_[1]);
    // [end:ping-pong]
}

const TexturePair& VisibilitySums::resolve(int directions) {
    resolve_.setTexture("uSeen", GL_TEXTURE_2D, sums_[0]->first());
    resolve_.setTexture("uReceived", GL_TEXTURE_2D, sums_[0]->second());
    resolve_.set("uPerDirection", 1.0f / float(directions));
    resolve_.prepareToDraw();
    sums_[1]->bind();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
    return *sums_[1];
}

std::vector<Program*> VisibilitySums::programs() {
    std::vector<Program*> all = add_.compiled();
    all.push_back(&resolve_);
    return all;
}

}  // namespace penumbra
