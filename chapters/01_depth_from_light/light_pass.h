// Pass 1, as every chapter with a shadow map begins: the scene from the light.
#pragma once

#include <optional>
#include <vector>

#include "chapters/01_depth_from_light/depth_view.h"
#include "chapters/01_depth_from_light/shadow_options.h"

namespace penumbra {

/// What the light sees, for the second pass to read. Valid until the next frame.
struct LightSight {
    ShadowMap& map;
    const Light& light;
    const LightFrustum& frustum;
};

class LightPass {
 public:
    ShadowOptions options;

    /// Compiles its programs; what the map held is gone. Call it when a chapter loads a scene.
    void load();
    /// The chosen light, its frustum for this frame, and a map of the wanted size and format, not drawn yet.
    LightSight fit(const Frame& frame);
    /// Draws the map of `sight`, unless it holds all that already (ShadowMap::render).
    void draw(const Frame& frame, const LightSight& sight, const CasterDraw& draw = {});
    /// Both.
    LightSight render(const Frame& frame);
    /// The map as the picture: window depth, or metres along the light's axis.
    void show(const Frame& frame, const LightSight& sight, bool linear = false);
    /// Its own programs and `others`, for hot reload.
    std::vector<Program*> programs(std::vector<Program*> others);

 private:
    std::optional<Program> depth_;
    std::optional<DepthView> view_;
    std::optional<ShadowMap> map_;
};

}  // namespace penumbra
