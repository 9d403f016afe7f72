#include "chapters/00_ray_traced_truth/shadow_rays.h"

#include <algorithm>
#include <vector>

namespace penumbra {

namespace {

// [begin:rounded-start]
ShadowRay shadowRay(const Hit& hit, const Light& light, const LightSample& sample,
                    const ShadowRayOptions& options) {
    ShadowRay ray = ShadowRay::from(hit, sample.target, light.type == LightType::directional);
    if (options.start == "rounded") {
        ray.origin = glm::dvec3(glm::vec3(hit.position));
        ray.triangle = ShadowRay::noTriangle;
        ray.normal = glm::dvec3(0.0);
    }
    return ray;
}
// [end:rounded-start]

void castRange(const RayTracer& tracer, const Hit& hit, const Light& light,
               std::span<const LightSample> samples, const ShadowRayOptions& options,
               std::span<std::uint8_t> seen, RayCounts& counts) {
    std::vector<ShadowRay> rays;
    std::vector<std::size_t> indices;
    const auto facesAway = [&](std::size_t i) {
        return glm::dot(hit.shadingNormal, samples[i].toLight) <= 0.0;
    };
    for (std::size_t i = 0; i < samples.size(); ++i) {
        seen[i] = 0;
        if (options.skip && facesAway(i)) {
            ++counts.savedFacingAway;
            continue;
        }
        rays.push_back(shadowRay(hit, light, samples[i], options));
        indices.push_back(i);
    }
    std::vector<std::uint8_t> blocked(rays.size());
    tracer.occluded(rays, blocked, light.part);
    // Facing away is not seen, traced or not: --adaptive asks whether all agree.
    for (std::size_t k = 0; k < rays.size(); ++k)
        seen[indices[k]] = blocked[k] || facesAway(indices[k]) ? 0 : 1;
    counts.traced += std::int64_t(rays.size());
}

}  // namespace

// [begin:adaptive]
void castShadowRays(const RayTracer& tracer, const Hit& hit, const Light& light,
                    std::span<const LightSample> samples, const ShadowRayOptions& options,
                    std::span<std::uint8_t> seen, RayCounts& counts) {
    const std::size_t probe = options.adaptive ? std::min<std::size_t>(16, samples.size()) : samples.size();
    castRange(tracer, hit, light, samples.first(probe), options, seen.first(probe), counts);
    const bool agree =
        std::all_of(seen.begin(), seen.begin() + long(probe), [&](auto s) { return s == seen[0]; });
    if (agree && probe < samples.size()) {
        std::fill(seen.begin() + long(probe), seen.end(), seen[0]);
        counts.savedByAgreement += std::int64_t(samples.size() - probe);
    } else {
        castRange(tracer, hit, light, samples.subspan(probe), options, seen.subspan(probe), counts);
    }
}
// [end:adaptive]

}  // namespace penumbra
