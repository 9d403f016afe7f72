// Draws what may come between a light and a receiver, projected on the receiver's texture.
#pragma once

#include <vector>

#include "chapters/08_accumulation/shadow_plan.h"
#include "common/app/chapter.h"

namespace penumbra {

class OccluderPass {
 public:
    /// Hands the matrices of all points of the plan to the GPU, and keeps a reference to it.
    void begin(const Frame& frame, const ShadowPlan& plan, int lightPart);
    /// Draws the occluders from points [first, first + count), gl_InstanceID 0 being `first`, with `program`
    /// (project.vert). The caller has bound the target. Counts occluders_drawn (triangles) and draw_calls.
    void draw(Program& program, int first, int count);

 private:
    const Frame* frame_ = nullptr;
    const ShadowPlan* plan_ = nullptr;
    int lightPart_ = -1;
    GlBuffer matrices_;
};

}  // namespace penumbra
