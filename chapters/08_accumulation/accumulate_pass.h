// --method accumulate: clear, draw, add, once per light point (Heckbert & Herf 1997).
#pragma once

#include <optional>

#include "chapters/06_jitter_texture/program_variants.h"
#include "chapters/08_accumulation/occluder_pass.h"
#include "chapters/08_accumulation/texel_target.h"
#include "common/gl/fullscreen.h"

namespace penumbra {

/// The uniforms of weight.glsl.
void setPlane(Program& program, const Receiver& receiver);
/// The defines of what includes weight.glsl.
std::vector<std::string> weightDefines(const std::string& weights);

class AccumulatePass {
 public:
    AccumulatePass();
    /// Fills `sums`: r of visible weights, g of all. `weights`: of each point of the plan.
    void run(const Frame& frame, const Receiver& receiver, const ShadowPlan& plan, int lightPart,
             const std::vector<glm::vec4>& weights, const std::string& weighting, const TexelTarget& sums);
    std::vector<Program*> programs();

 private:
    Program occluder_;
    ProgramVariants add_;
    OccluderPass occluders_;
    std::optional<TexelTarget> covered_;
    FullscreenTriangle triangle_;
};

}  // namespace penumbra
