// What of a scene is no receiver.
#pragma once

#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "common/app/chapter.h"

namespace penumbra {

/// The triangles that belong to no receiver: curved, small, or facing no light.
class OtherSurfaces {
 public:
    /// Of the frame's scene; sorts out once what all draws of the frame share.
    OtherSurfaces(const Frame& frame, const std::vector<Receiver>& receivers);

    /// How many there are, lights' own surfaces not counted: those receive nothing.
    std::int64_t count() const { return count_; }
    /// Draws those that the camera of the frame can see (clustersUnseen), materials
    /// set. Counts triangles_shaded and draw_calls.
    void draw(Program& program, const Frame& frame) const;

 private:
    /// One material's triangles, and a part that has it.
    struct Run {
        int part = 0;
        std::vector<IndexRange> ranges;
    };
    std::vector<Run> seen_;
    std::int64_t count_ = 0;
};

/// Neighbouring triangles in one range. `triangles` ascending.
std::vector<IndexRange> rangesOf(const std::vector<std::uint32_t>& triangles);

}  // namespace penumbra
