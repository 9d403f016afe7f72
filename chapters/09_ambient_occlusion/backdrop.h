// The sky behind the surfaces.
#pragma once

#include <optional>
#include <string>

#include "chapters/08_accumulation/texel_target.h"
#include "chapters/09_ambient_occlusion/ambient_options.h"
#include "common/app/chapter.h"
#include "common/gl/fullscreen.h"

namespace penumbra {

class Backdrop {
 public:
    /// Clears the frame, depth too, and fills it with the sky that shines if that is to be `seen`.
    void draw(const Frame& frame, const AmbientOptions& options, bool seen);
    Program& program() { return program_; }

 private:
    Program program_{"common/fullscreen.vert", "09_ambient_occlusion/backdrop.frag"};
    FullscreenTriangle triangle_;
    std::optional<TexelTexture> sky_;
    std::string key_;
};

}  // namespace penumbra
