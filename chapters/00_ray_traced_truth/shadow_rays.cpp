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

bool facesAway(const Hit& hit, const LightSample& sample) {
    return glm::dot(hit.shadingNormal, sample.toLight) <= 0.0;
}

void castRange(const RayTracer& tracer, const Hit& hit, const Light& light,
               std::span<const LightSample> samples, const ShadowRayOptions& options,
               std::span<std::uint8_t> seen, RayCounts& counts) {
    std::vector<ShadowRay> rays;
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        seen[i] = 0;
        if (options.skip && facesAway(hit, samples[i])) {
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
        seen[indices[k]] = blocked[k] || facesAway(hit, samples[indices[k]]) ? 0 : 1;
    counts.traced += std::int64_t(rays.size());
}

}  // namespace

// [begin:adaptive]
void castShadowRays(const RayTracer& tracer, const Hit& hit, const Light& light,
                    std::span<const LightSample> samples, const ShadowRayOptions& options,
                    std::span<std::uint8_t> seen, RayCounts& counts) {
    // A sample below the horizon is multiplied by 0 and has no say: where the light rises or sets, the first
    // 16 may all lie below, and "nothing of it is seen" would be a guess about a light that nobody looked at.
    const std::size_t enough = options.adaptive ? 16 : samples.size();
    std::size_t probe = 0, asked = 0;
    while (probe < samples.size() && asked < enough) asked += facesAway(hit, samples[probe++]) ? 0 : 1;
    castRange(tracer, hit, light, samples.first(probe), options, seen.first(probe), counts);
    const auto answered = std::size_t(std::count(seen.begin(), seen.begin() + long(probe), 1));
    if (probe < samples.size() && (answered == 0 || answered == asked)) {
        std::fill(seen.begin() + long(probe), seen.end(), answered == 0 ? 0 : 1);
        counts.savedByAgreement += std::int64_t(samples.size() - probe);
    } else {
        castRange(tracer, hit, light, samples.subspan(probe), options, seen.subspan(probe), counts);
    }
}
// [end:adaptive]

}  // namespace penumbra
