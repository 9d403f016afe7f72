#include "chapters/08_accumulation/map_pass.h"

#include "chapters/02_shadow_test/shadow_test.h"
#include "chapters/03_polygon_offset/depth_bias.h"
#include "chapters/08_accumulation/slow_frame.h"
#include "chapters/08_accumulation/stored_shadow.h"
#include "common/app/pass_timer.h"
#include "common/scene/gpu_light.h"

namespace penumbra {

namespace {

void setCamera(Program& program, const Frame& frame) {
    program.set("uClipFromWorld",
                glm::mat4(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y)));
}

/// One point of a light, as a light of emission 1.
Light pointOf(const Light& light, const LightPoint& point) {
    Light result = light;
    result.emission = glm::dvec3(1.0);
    if (light.type != LightType::area) return result;
    result.position = point.position;
    result.area = point.weight;
    return result;
}

}  // namespace

MapPass::MapPass()
    : depth_("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag"),
      camera_("08_accumulation/picture.vert", "08_accumulation/depth_only.frag"),
      add_("08_accumulation/picture.vert", "08_accumulation/add_map.frag") {}

const TexelTarget& MapPass::run(const Frame& frame, const ShadowOptions& options, const Light& light,
                                const std::vector<LightPoint>& points, const Draw& drawSeen) {
    const PassScope scope(frame.passTimer, "shadow maps");
    const GLenum format = sumFormat(frame.context->capabilities(), "32f");
    if (!sums_ || sums_->size() != frame.size) sums_.emplace(frame.size, format, true);
    const ProgressCallback slowProgress = slowFrameProgress(frame);
    // [begin:shadow-maps]
    // The camera's depths first, so that only what it sees is added to.
    sums_->clear(glm::vec4(0.0f));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    setCamera(camera_, frame);
    drawSeen(camera_);
    const float none[4] = {0.0f, 0.0f, 0.0f, 0.0f};  // a shader without an output leaves anything there
    glClearBufferfv(GL_COLOR, 0, none);
    for (std::size_t i = 0; i < points.size(); ++i) {
        add(frame, options, pointOf(light, points[i]), drawSeen);
        slowProgress(double(i + 1) / double(points.size()));
    }
    // [end:shadow-maps]
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glViewport(0, 0, frame.size.x, frame.size.y);
    return *sums_;
}

void MapPass::add(const Frame& frame, const ShadowOptions& options, const Light& point,
                  const Draw& drawSeen) {
    ShadowMap& map = options.provide(map_, frame.context->capabilities());
    const LightFrustum frustum = fitLightFrustum(frame.scene, point, depthRange(map.format()));
    map.render(depth_, frame, point, frustum);

    sums_->bind();
    setCamera(add_, frame);
    setLight(add_, point);
    setShadowMap(add_, map, frustum, point, "lit");
    setDepthErrors(add_, bothPassesErrors(map, frustum, frame.scene.bounds), frustum);
    add_.set("uBias", 1.0f);
    add_.set("uFollowPlane", 0.0f);
    glDepthFunc(GL_EQUAL);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    drawSeen(add_);
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);
    glDepthFunc(GL_LESS);
}

}  // namespace penumbra
