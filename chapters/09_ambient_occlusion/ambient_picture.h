// The camera's picture: every surface with what it sees of the sky, and the sky behind.
#pragma once

#include <optional>
#include <string>

#include "chapters/08_accumulation/texel_target.h"
#include "chapters/09_ambient_occlusion/backdrop.h"
#include "chapters/09_ambient_occlusion/baked_ambient.h"
#include "chapters/09_ambient_occlusion/pixel_rays.h"
#include "common/gl/fullscreen.h"

namespace penumbra {

class AmbientPicture {
 public:
    /// Each draws frame.view.
    void drawHemisphere(const Frame& frame, const AmbientOptions& options);
    void drawPixels(const Frame& frame, const AmbientOptions& options, const PixelRays& pixels);
    void drawBaked(const Frame& frame, const AmbientOptions& options, const BakedAmbient& baked);
    /// A picture from the CPU, RGBA, rows up.
    void show(const Frame& frame, const std::vector<float>& picture);
    std::vector<Program*> programs();

 private:
    void begin(Program& program, const Frame& frame, const AmbientOptions& options);

    Program hemisphere_{"09_ambient_occlusion/ambient.vert", "09_ambient_occlusion/ambient.frag"};
    Program hemisphereUniform_{
        "09_ambient_occlusion/ambient.vert", "09_ambient_occlusion/ambient.frag", {"UNIFORM_WEIGHTING"}};
    Program pixels_{"09_ambient_occlusion/ambient.vert", "09_ambient_occlusion/ambient.frag", {"PIXELS"}};
    Program stored_{"09_ambient_occlusion/ambient.vert", "09_ambient_occlusion/ambient.frag", {"STORED"}};
    Program shown_{"common/fullscreen.vert", "09_ambient_occlusion/shown.frag"};
    Backdrop backdrop_;
    FullscreenTriangle triangle_;
    std::optional<TexelTexture> picture_;
};

}  // namespace penumbra
