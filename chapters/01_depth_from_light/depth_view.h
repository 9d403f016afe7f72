// Shows a depth map as a picture.
#pragma once

#include "chapters/01_depth_from_light/shadow_map.h"
#include "common/gl/fullscreen.h"

namespace penumbra {

class DepthView {
 public:
    DepthView();
    /// Fills the largest centred square of the frame's picture with the map: window depth, or metres along
    /// the light's axis.
    void draw(const Frame& frame, const ShadowMap& map, const LightFrustum& frustum, bool linear);
    Program& program() { return program_; }

 private:
    Program program_;
    FullscreenTriangle triangle_;
};

}  // namespace penumbra
