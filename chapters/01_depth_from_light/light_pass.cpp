#include "chapters/01_depth_from_light/light_pass.h"

namespace penumbra {

void LightPass::load() {
    depth_.emplace("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
    view_.emplace();
    map_.reset();
}

// [begin:light-pass]
LightSight LightPass::fit(const Frame& frame) {
    ShadowMap& map = options.provide(map_, frame.context->capabilities());
    return {map, options.chosenLight(frame.scene), options.frustum(frame, map)};
}

void LightPass::draw(const Frame& frame, const LightSight& sight, const CasterDraw& draw) {
    sight.map.render(*depth_, frame, sight.light, sight.frustum, draw);
}

LightSight LightPass::render(const Frame& frame) {
    const LightSight sight = fit(frame);
    draw(frame, sight);
    return sight;
}
// [end:light-pass]

void LightPass::show(const Frame& frame, const LightSight& sight, bool linear) {
    clearPicture(frame, options);
    view_->draw(frame, sight.map, sight.frustum, linear);
}

std::vector<Program*> LightPass::programs(std::vector<Program*> others) {
    others.insert(others.end(), {&*depth_, &view_->program()});
    return others;
}

}  // namespace penumbra
