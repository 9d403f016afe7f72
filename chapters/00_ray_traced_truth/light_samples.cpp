#include "chapters/00_ray_traced_truth/light_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/math/sampling.h"
#include "common/truth/polygon_light.h"

namespace penumbra {

glm::dvec3 pointOnLight(const Light& light, glm::dvec2 u) {
    double below = 0.0;
    for (const auto& polygon : light.polygons) {
        const double share = polygonArea(polygon) / light.area;
        if (u.x < below + share || &polygon == &light.polygons.back()) {
            u.x = std::clamp((u.x - below) / share, 0.0, 1.0);
            return pointInPolygon(polygon, u);
        }
        below += share;
    }
    return light.position;
}

namespace {

std::vector<LightSample> sampleArea(const Light& light, const Hit& hit, int count, std::uint32_t seed) {
    // [begin:lambert]
    double exact = 0.0;  // form factor of the whole light, nothing in between
    for (const auto& polygon : light.polygons) exact += formFactor(hit.position, hit.shadingNormal, polygon);
    if (exact <= 0.0) return {};
    // [end:lambert]

    // [begin:area-samples]
    std::vector<LightSample> samples(static_cast<std::size_t>(count));
    double sum = 0.0;  // what the samples alone would say the form factor is, up to a constant
    for (int i = 0; i < count; ++i) {
        LightSample& sample = samples[std::size_t(i)];
        sample.target = pointOnLight(light, owenSobol(std::uint32_t(i), seed));
        const glm::dvec3 offset = sample.target - hit.position;
        const double distance = glm::length(offset);
        sample.toLight = offset / distance;
        const double weight =
            std::max(0.0, -glm::dot(light.direction, sample.toLight)) / (distance * distance);
        sample.facingIrradiance = glm::dvec3(weight);
        sum += weight * std::max(0.0, glm::dot(hit.shadingNormal, sample.toLight));
    }
    if (sum <= 0.0) return {};
    const glm::dvec3 scale = light.emission * (std::numbers::pi * exact / sum);
    for (LightSample& sample : samples) sample.facingIrradiance *= scale;
    return samples;
    // [end:area-samples]
}

}  // namespace

std::vector<LightSample> sampleLight(const Light& light, const Hit& hit, int count, std::uint32_t seed) {
    if (light.type == LightType::area) return sampleArea(light, hit, count, seed);
    LightSample sample;
    sample.toLight = directionToLight(light, hit.position);
    sample.target = light.type == LightType::directional ? sample.toLight : light.position;
    sample.facingIrradiance = facingIrradiance(light, hit.position);
    return {sample};
}

}  // namespace penumbra
