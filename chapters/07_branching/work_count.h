// How many pixels did what: a picture of the work, added up.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/app/chapter.h"
#include "common/gl/render_target.h"

namespace penumbra {

struct PixelCounts {
    std::int64_t receiving = 0;  ///< on the map and facing the light
    std::int64_t looked = 0;     ///< ... and not out of every caster's reach
    std::int64_t searched = 0;   ///< ... and tested with all samples
};

class WorkCount {
 public:
    /// Draws with `draw` (red: receiving, green: looked, blue: searched) into a target of its own and counts,
    /// unless nothing in `state` has changed since the last time: so that a timed frame is not counted again.
    /// Leaves frame.framebuffer bound.
    const PixelCounts& count(const Frame& frame, const std::string& state, const std::function<void()>& draw);

 private:
    std::unique_ptr<RenderTarget> target_;
    std::string state_;
    PixelCounts counts_;
};

}  // namespace penumbra
