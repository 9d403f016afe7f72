// How many pixels did what: a picture of the work, added up.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/app/chapter.h"
#include "common/gl/program.h"
#include "common/gl/render_target.h"

namespace penumbra {

struct PixelCounts {
    std::int64_t receiving = 0;  ///< on the map and facing the light
    std::int64_t looked = 0;     ///< ... and not out of every caster's reach
    std::int64_t searched = 0;   ///< ... and tested with all samples
};

class WorkCount {
 public:
    /// Draws the scene with the program that `prepare` returns (red: receiving, green: looked, blue:
    /// searched) into a target of its own and counts, unless nothing in `state` has changed since the last
    /// time: so that a timed frame is not counted again. `prepare` may draw maps elsewhere: it is called
    /// before the target is bound, or the flags would land in the picture and all counts be 0. Leaves
    /// frame.framebuffer bound.
    const PixelCounts& count(const Frame& frame, const std::string& state,
                             const std::function<Program&()>& prepare);

 private:
    std::unique_ptr<RenderTarget> target_;
    std::string state_;
    PixelCounts counts_;
};

}  // namespace penumbra
