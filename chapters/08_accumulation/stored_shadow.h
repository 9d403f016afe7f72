// One light on one receiver: the shadow it throws there, kept until something it depends on changes.
#pragma once

#include <optional>
#include <string>

#include "chapters/08_accumulation/accumulate_pass.h"
#include "chapters/08_accumulation/accumulation_options.h"
#include "chapters/08_accumulation/mask_pass.h"

namespace penumbra {

inline constexpr Skip keptShadows{
    "kept-shadows", "occluders_drawn",
    "the shadow of a light on a receiver, and what would arrive without it, are "
    "kept from the frame before while neither has changed (a window, --still)"};
inline constexpr Skip texelsAgreeing{"texels-agreeing", "texels_weighed",
                                     "no weights are added up where all light points are seen, or none: the "
                                     "share is 1 or 0 (--method mask)"};
inline constexpr Skip trianglesOffBlock{"triangles-off-block", "triangle_tests",
                                        "a texel does not look at triangles that shadow no texel of its "
                                        "block (--method exact)"};

/// What all receivers share.
struct ShadowPasses {
    AccumulatePass accumulate;
    MaskPass mask;
};

class StoredShadow {
 public:
    /// Everything that is asked of a light and a receiver in one frame. `whole`: the light as it is in the
    /// scene, whose points are stored; `lit`: what is on of it.
    struct Request {
        const Frame& frame;
        const AccumulationOptions& options;
        const Receiver& receiver;
        const Light& whole;
        const Light& lit;
        ProgressCallback progress{};  ///< of this light on this receiver alone
    };

    /// Makes `sums` right, drawing occluders only if geometry or points changed. Counts what it did.
    void update(const Request& request, ShadowPasses& passes);
    /// Irradiance without occluders, computed (on the CPU, in double) when first asked for.
    GLuint unoccluded(const Request& request);

    const ShadowPlan& plan() const { return plan_; }
    /// Of the methods accumulate and exact; null unless something reaches between light and receiver.
    const TexelTarget* sums() const { return sums_ ? &*sums_ : nullptr; }
    /// Of the method mask, likewise.
    const PackedSums* packedSums() const { return packed_ ? &*packed_ : nullptr; }
    /// (seen, all) of each texel, row 0 at v = 0; empty where nothing reaches in between. Waits for the GPU.
    std::vector<glm::vec2> readSums() const;
    const MaskLayers* masks() const { return masks_ ? &*masks_ : nullptr; }
    /// Of the weights in `sums`, see PointWeights.
    double weightScale() const { return scale_; }
    /// Another number whenever what is above has changed.
    std::uint64_t revision() const { return revision_; }

 private:
    void drawShadows(const Request& request, ShadowPasses& passes);
    void addWeights(const Request& request, ShadowPasses& passes);
    void solve(const Request& request);
    void count(const Request& request);
    std::int64_t mixedTexels(const Request& request) const;
    PointWeights weightsOf(const Request& request) const;
    void provideSums(const Request& request);

    ShadowPlan plan_;
    std::optional<TexelTarget> sums_;
    std::optional<TexelTexture> unoccluded_;
    std::optional<PackedSums> packed_;
    std::optional<MaskLayers> masks_;
    std::string shadowKey_, lightKey_, unoccludedKey_, countedKey_;
    double scale_ = 1.0;
    std::int64_t mixed_ = 0;
    bool weighedEverywhere_ = false;  ///< not only where points disagree: texelsAgreeing
    std::uint64_t revision_ = 0;
};

/// Float textures that can be added to: 32 bits where the context has them, else 16.
GLenum sumFormat(const Capabilities& capabilities, const std::string& target);

}  // namespace penumbra
