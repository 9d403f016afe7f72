#include "chapters/01_depth_from_light/shadow_options.h"

#include <fmt/format.h>

#include "common/error.h"
#include "common/scene/gpu_light.h"

namespace penumbra {

void ShadowOptions::declare(Parameters& parameters) {
    parameters.add("light", light, 0, 63, "", "index of the light, when the scene has several");
    parameters.add("map-size", mapSize, 16, 8192, "texels",
                   "side of the shadow map; 64: staircases, 4096: fine, slow and mostly wasted");
    parameters.add("depth-format", depthFormat, depthFormatNames(),
                   "bits of a depth; 16: far surfaces fall into steps; 32f-reversed needs glClipControl");
    parameters.add(
        "fit", fit, {"scene", "view"},
        "what the map holds: all that the light reaches, so that it is drawn once, or what the camera "
        "sees of it, with finer texels whose edges crawl while the camera moves");
    declareMapSkips(parameters.skips());
}

void declareMapSkips(Skips& skips) {
    for (const Skip* skip : {&keptMaps, &clustersOffMap, &clustersUnseen}) skips.declare(*skip);
}

bool ShadowOptions::Fitted::sameAs(const Fitted& other) const {
    return scene == other.scene && light == other.light && range == other.range && camera == other.camera &&
           (!camera || aspect == other.aspect);
}

const LightFrustum& ShadowOptions::frustum(const Scene& scene, const Camera& camera,
                                           const glm::ivec2& pictureSize, DepthFormat format) const {
    Fitted wanted{&scene, light, depthRange(format), std::nullopt, double(pictureSize.x) / pictureSize.y};
    if (fit == "view") wanted.camera = camera;
    if (fitted_ && fitted_->sameAs(wanted)) return fitted_->frustum;
    const Light& chosen = chosenLight(scene);
    wanted.frustum = wanted.camera ? fitLightFrustum(scene, chosen, camera, wanted.aspect, wanted.range)
                                   : fitLightFrustum(scene, chosen, wanted.range);
    fitted_ = wanted;
    return fitted_->frustum;
}

const Light& ShadowOptions::chosenLight(const Scene& scene) const {
    if (std::size_t(light) >= scene.lights.size())
        throw UsageError(fmt::format("--light {}: scene {} has lights 0 to {}", light, scene.name,
                                     scene.lights.size() - 1));
    return scene.lights[std::size_t(light)];
}

ShadowMap& ShadowOptions::provide(std::optional<ShadowMap>& map, const Capabilities& capabilities) const {
    const DepthFormat format = penumbra::depthFormat(depthFormat, capabilities);
    if (!map || map->size() != mapSize || map->format() != format) map.emplace(mapSize, format);
    return *map;
}

void setCameraAndLight(Program& program, const Frame& frame, const ShadowOptions& options) {
    const double aspect = double(frame.size.x) / frame.size.y;
    program.set("uClipFromWorld", glm::mat4(clipFromWorld(frame.camera, aspect)));
    program.set("uEye", glm::vec3(frame.camera.position));
    program.set("uAmbientRadiance", ambientRadiance(frame.scene, options.light, ambientShare));
    setLight(program, options.chosenLight(frame.scene));
}

void clearPicture(const Frame& frame, const ShadowOptions& options) {
    glm::vec3 background(0.0f);
    if (frame.view == "color" || frame.view == "light-view")
        background = ambientRadiance(frame.scene, options.light, ambientShare);
    glClearColor(background.r, background.g, background.b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void drawPicture(Program& program, const Frame& frame) {
    drawPicture(program, frame, *frame.gpu);
}

void drawPicture(Program& program, const Frame& frame, const GpuScene& gpu) {
    const Frustum seen(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y));
    const VisibleClusters visible =
        frame.skips(clustersUnseen) ? visibleClusters(frame.scene, seen) : allClusters(frame.scene);
    const DrawCounts drawn = gpu.drawShaded(program, visible);
    frame.work["triangles_shaded"] += std::int64_t(drawn.triangles);
    frame.work["triangles_unseen"] += std::int64_t(frame.scene.triangleCount() - drawn.triangles);
    frame.work["draw_calls"] += std::int64_t(drawn.drawCalls);
}

}  // namespace penumbra
