// --method mask: 32 light points in one draw call, a bit each; then the weights of the bits that stayed
// clear.
#pragma once

#include "chapters/06_jitter_texture/program_variants.h"
#include "chapters/08_accumulation/occluder_pass.h"
#include "chapters/08_accumulation/texel_target.h"

namespace penumbra {

class MaskPass {
 public:
    MaskPass();
    /// Sets the bits of all points of the plan.
    void draw(const Frame& frame, const ShadowPlan& plan, int lightPart, const MaskLayers& masks);
    /// Fills `sums` (which has a depth buffer) from the masks: r of visible weights, g of all; or (V, 1)
    /// where all points agree, unless `everywhere`: the same V.
    void resolve(const Receiver& receiver, const ShadowPlan& plan, const std::vector<glm::vec4>& weights,
                 const std::string& weighting, bool everywhere, const MaskLayers& masks,
                 const PackedSums& sums);
    std::vector<Program*> programs();

 private:
    void drawByLogicOp(const ShadowPlan& plan, const MaskLayers& masks);
    void drawByStencil(const ShadowPlan& plan, const MaskLayers& masks);
    void drawTexels(Program& program, const PackedSums& sums);

    Program bits_, byteBits_;
    ProgramVariants classify_, resolve_;
    OccluderPass occluders_;
    GlBuffer texels_;
    GlVertexArray texelArray_;
    GLsizei texelCount_ = 0;
};

}  // namespace penumbra
