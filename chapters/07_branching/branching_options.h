// The parameters of chapter 07, and what they make.
#pragma once

#include <optional>
#include <string>

#include "chapters/06_jitter_texture/jitter_options.h"
#include "chapters/07_branching/caster_reach.h"
#include "chapters/07_branching/min_max_map.h"
#include "chapters/07_branching/receiver_slopes.h"
#include "chapters/07_branching/work_count.h"

namespace penumbra {

class BranchingOptions {
 public:
    JitterOptions jitter;
    std::string classify = "min-max", branch = "loop", penumbra = "fixed";

    /// Declares the parameters of chapter 06 and --classify, --branch and --penumbra.
    void declare(Parameters& parameters);
    /// Call it when a chapter loads a scene.
    void load(const Scene& scene);
    /// What branching.frag has to be compiled with for `view`: 3 is the work, 4 what it is counted from.
    std::vector<std::string> defines(int view) const;
    /// Makes what classification needs (once for each map), and sets all uniforms of branching.frag but those
    /// of setShadowMap.
    void set(Program& program, const ShadowMap& map, const LightFrustum& frustum, const Light& light,
             const Frame& frame);
    /// The report's counters.
    void count(const PixelCounts& pixels, WorkCounters& work) const;
    std::vector<Program*> programs();

    bool hardening() const { return penumbra == "contact-hardening"; }
    /// Texels that a kernel may read around a point.
    float reach() const;

 private:
    static void setLightSize(Program& program, const LightFrustum& frustum, const Light& light);

    std::vector<ReceiverPlane> planes_;
    std::optional<Floor> floor_;
    std::optional<MinMaxMap> minMax_;
};

}  // namespace penumbra
