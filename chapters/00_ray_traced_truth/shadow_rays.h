// Shadow rays from one point to the samples of one light.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "chapters/00_ray_traced_truth/light_samples.h"
#include "common/app/skips.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

inline constexpr Skip raysFacingAway{"rays-facing-away", "shadow_rays",
                                     "no shadow ray where the surface faces away from the light: whatever "
                                     "it finds, it is multiplied by 0"};

struct ShadowRayOptions {
    bool adaptive = true;
    /// "exact": see ray_tracer.h. "rounded": starts at the point rounded to float, and its own triangle
    /// counts: acne.
    std::string start = "exact";
    bool skip = true;  ///< raysFacingAway
};

/// Rays of one picture, added up.
struct RayCounts {
    std::int64_t traced = 0;
    std::int64_t savedFacingAway = 0;
    std::int64_t savedByAgreement = 0;
};

/// S(x, l): seen[i] becomes 1 where nothing stands between the hit and samples[i], else 0. With `adaptive`,
/// the first 16 samples of an area light that are above the surface's horizon are asked, and the others only
/// if those disagree: cheap and nearly right. A penumbra of which 16 rays see nothing is missed, and with it
/// up to a sixteenth of the light.
void castShadowRays(const RayTracer& tracer, const Hit& hit, const Light& light,
                    std::span<const LightSample> samples, const ShadowRayOptions& options,
                    std::span<std::uint8_t> seen, RayCounts& counts);

}  // namespace penumbra
