#include "chapters/10_accumulated_occlusion/sky_maps.h"

#include <algorithm>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "common/app/pass_timer.h"

namespace penumbra {

int SkyMaps::layersFor(int mapSize, int most) {
    constexpr std::int64_t mostBytes = 128 << 20;
    return int(std::clamp<std::int64_t>(mostBytes / (4 * std::int64_t(mapSize) * mapSize), 1, most));
}

BoundingSphere boundingSphere(const Scene& scene) {
    // A centre that floats can hold: what shaders subtract is the sphere's own.
    BoundingSphere sphere{glm::vec3(scene.bounds.centre()), 1e-6};
    for (const glm::vec3& p : scene.positions)
        sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, glm::dvec3(p)));
    return sphere;
}

// [begin:sky-frustum]
LightFrustum skyFrustum(const BoundingSphere& sphere, const glm::dvec3& toSky) {
    const double radius = sphere.radius * (1.0 + 1e-3);  // what lies on the sphere is inside, however rounded
    LightFrustum frustum;
    frustum.orthographic = true;
    frustum.eye = sphere.centre;
    frustum.lightViewFromWorld = viewFromWorld(sphere.centre, -toSky);
    frustum.halfExtent = glm::dvec2(radius);
    frustum.near = -radius;
    frustum.far = radius;
    return frustum;
}
// [end:sky-frustum]

SkyBias skyBias(DepthFormat format, std::span<const LightFrustum> frusta, const Aabb& bounds, int mapSize) {
    SkyBias bias;
    for (const LightFrustum& frustum : frusta) {
        // Both passes, and the interpolation from vertices to receivers: chapter 03.
        const DepthErrors errors = depthErrors(format, frustum, bounds, 3 * transformOperations);
        const float perSlope = (0.5f + errors.snap) / float(mapSize) + errors.rounding.x + errors.rounding.z +
                               errors.rasterError.y;
        const float constant = errors.quantum.x + errors.quantum.y + errors.rounding.y + errors.rounding.z +
                               errors.rasterError.x + errors.rasterError.y;
        bias = {std::max(bias.perSlope, perSlope), std::max(bias.constant, constant)};
    }
    return bias;
}

SkyMaps::SkyMaps(int mapSize, DepthFormat format, int layers)
    : mapSize_(mapSize), format_(format), framebuffers_(std::size_t(layers)) {
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.id());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GLint(internalFormat(format)), mapSize, mapSize, layers, 0,
                 GL_DEPTH_COMPONENT, transferType(format), nullptr);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (int layer = 0; layer < layers; ++layer) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[std::size_t(layer)].id());
        glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, texture_.id(), 0, layer);
        const GLenum none = GL_NONE;
        glDrawBuffers(1, &none);
        glReadBuffer(GL_NONE);
        requireCompleteFramebuffer("a layer of shadow maps");
    }
}

// [begin:depth-passes]
void SkyMaps::render(Program& program, const Frame& frame, std::span<const LightFrustum> frusta) {
    const PassScope scope(frame.passTimer, "depth");
    const VisibleClusters all = allClusters(frame.scene);  // every map holds the whole scene
    const float farthest = 1.0f;
    glViewport(0, 0, mapSize_, mapSize_);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    for (std::size_t layer = 0; layer < frusta.size(); ++layer) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[layer].id());
        glClearBufferfv(GL_DEPTH, 0, &farthest);
        program.set("uLightClipFromWorld", glm::mat4(frusta[layer].clipFromWorld()));
        program.prepareToDraw();
        const DrawCounts drawn = frame.gpu->drawDepth({&all});
        frame.work["triangles_submitted"] += std::int64_t(drawn.triangles);
        frame.work["draw_calls"] += std::int64_t(drawn.drawCalls);
    }
    frame.work["shadow_maps_rendered"] += std::int64_t(frusta.size());
}
// [end:depth-passes]

}  // namespace penumbra
