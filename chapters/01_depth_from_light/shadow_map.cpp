#include "chapters/01_depth_from_light/shadow_map.h"

#include "common/app/pass_timer.h"

namespace penumbra {

// [begin:depth-texture]
ShadowMap::ShadowMap(int size, DepthFormat format) : size_(size), format_(format) {
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(internalFormat(format)), size, size, 0, GL_DEPTH_COMPONENT,
                 transferType(format), nullptr);
    // Depths must not be blended: half way between a wall and the floor behind it there is nothing.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);

    // A framebuffer of depth alone: no colour is computed, so none is paid for.
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_.id(), 0);
    const GLenum none = GL_NONE;
    glDrawBuffers(1, &none);
    glReadBuffer(GL_NONE);
    requireCompleteFramebuffer("shadow map");
}
// [end:depth-texture]

namespace {

/// The state a map is drawn in, put back when the drawing is done or throws.
class DepthState {
 public:
    DepthState(const ShadowMap& map, const CasterDraw& draw, GLuint framebufferAfter)
        : reversed_(depthRange(map.format()) == DepthRange::reversed), framebufferAfter_(framebufferAfter) {
        glGetIntegerv(GL_VIEWPORT, viewportAfter_);
        glBindFramebuffer(GL_FRAMEBUFFER, map.framebuffer());
        glViewport(0, 0, map.size(), map.size());
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        if (reversed_) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glDepthFunc(reversed_ ? GL_GREATER : GL_LESS);
        // Offsets push away from the light, which is towards 0 when depth is reversed.
        const float away = reversed_ ? -1.0f : 1.0f;
        if (draw.offsetFactor != 0.0f || draw.offsetUnits != 0.0f) glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(away * draw.offsetFactor, away * draw.offsetUnits);
        const float farthest = reversed_ ? 0.0f : 1.0f;
        glClearBufferfv(GL_DEPTH, 0, &farthest);
    }
    ~DepthState() {
        glDisable(GL_POLYGON_OFFSET_FILL);
        glDepthFunc(GL_LESS);
        if (reversed_) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        glBindFramebuffer(GL_FRAMEBUFFER, framebufferAfter_);
        glViewport(viewportAfter_[0], viewportAfter_[1], viewportAfter_[2], viewportAfter_[3]);
    }
    DepthState(const DepthState&) = delete;
    DepthState& operator=(const DepthState&) = delete;

 private:
    bool reversed_;
    GLuint framebufferAfter_;
    GLint viewportAfter_[4];
};

}  // namespace

// [begin:depth-pass]
void ShadowMap::render(Program& program, const Frame& frame, const Light& light, const LightFrustum& frustum,
                       const CasterDraw& draw) {
    const Key wanted{frame.gpu, program.id(), light.part, frustum, draw};
    if (frame.skips(keptMaps) && !frame.renderMapsAgain && held_ == wanted) return;
    const PassScope scope(frame.passTimer, "depth");

    const glm::dmat4 lightClipFromWorld = frustum.clipFromWorld();
    const VisibleClusters visible =
        frame.skips(clustersOffMap) ? visibleClusters(frame.scene, Frustum(lightClipFromWorld, frustum.range))
                                    : allClusters(frame.scene);
    const DepthState state(*this, draw, frame.framebuffer);
    program.set("uLightClipFromWorld", glm::mat4(lightClipFromWorld));
    program.prepareToDraw();
    const bool cull = draw.cullClosed && !frustum.cutsCasters;
    const DrawCounts drawn = frame.gpu->drawDepth({&visible, cull, draw.frontFacesInstead, light.part});
    held_ = wanted;
    static std::uint64_t drawings = 0;
    revision_ = ++drawings;

    frame.work["shadow_maps_rendered"] += 1;
    frame.work["triangles_submitted"] += std::int64_t(drawn.triangles);
    frame.work["triangles_culled"] += std::int64_t(frame.scene.triangleCount() - drawn.triangles);
    frame.work["draw_calls"] += std::int64_t(drawn.drawCalls);
}
// [end:depth-pass]

}  // namespace penumbra
