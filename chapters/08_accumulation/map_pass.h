// N shadow maps added up: an area light on surfaces of any shape, seen by the camera.
#pragma once

#include <functional>
#include <optional>

#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/08_accumulation/light_points.h"
#include "chapters/08_accumulation/texel_target.h"

namespace penumbra {

class MapPass {
 public:
    MapPass();
    /// Sums of all light points' weights per pixel of the frame: r of those that are seen, g of all. One map
    /// of `options`' size for each point, drawn and looked up with chapter 03's derived bias. Counts as
    /// ShadowMap::render does.
    /// `drawSeen`: draws the surfaces in question.
    using Draw = std::function<void(Program&)>;
    const TexelTarget& run(const Frame& frame, const ShadowOptions& options, const Light& light,
                           const std::vector<LightPoint>& points, const Draw& drawSeen);
    std::vector<Program*> programs() { return {&depth_, &camera_, &add_}; }

 private:
    void add(const Frame& frame, const ShadowOptions& options, const Light& point, const Draw& drawSeen);

    Program depth_, camera_, add_;
    std::optional<ShadowMap> map_;
    std::optional<TexelTarget> sums_;
};

}  // namespace penumbra
