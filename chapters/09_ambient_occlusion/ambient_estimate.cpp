#include "chapters/09_ambient_occlusion/ambient_estimate.h"

#include <algorithm>
#include <cmath>

#include "common/math/hemisphere.h"
#include "common/math/sampling.h"
#include "common/truth/shadow_packet.h"

namespace penumbra {

namespace {

/// Sine of the angle below the surface that is still along it: once in 2^30 rays a direction is on the very
/// horizon, and rounding alone would say that it is below. An open plane would then not be exactly 1.
constexpr double tangent = 1e-14;

/// How far away is the surface that blocks this direction? A candidate in float is good enough, since the
/// falloff is continuous: an error of an ulp in the distance is one of an ulp in the openness. The start is
/// lifted off the surface as shadow rays are; without the lift the surface would now and then be its own
/// nearest blocker, which shows as black grains.
double distanceAlong(const RayTracer& tracer, const Hit& from, const glm::dvec3& direction) {
    ShadowRay ray = ShadowRay::from(from, direction, true);
    const double lift = 16.0 * ulpOf(ray, largestCoordinate(tracer.scene().bounds));
    const Hit hit = tracer.nearest({from.position + lift * from.geometricNormal, direction});
    if (!hit.valid) return 0.0;  // it was blocked within the lift
    return std::max(0.0, glm::dot(hit.position - from.position, direction));
}

}  // namespace

// [begin:falloff]
double openAt(double distance, const AmbientReach& reach) {
    const double t = std::clamp(distance / reach.range, 0.0, 1.0);
    return 1.0 - (1.0 - t) * (1.0 - t);
}
// [end:falloff]

glm::dvec3 bentNormal(const AmbientValue& value, const glm::dvec3& normal) {
    const double length = glm::length(value.bent);
    return length > 0.0 ? value.bent / length : normal;
}

// [begin:rays]
std::vector<double> openShares(const RayTracer& tracer, const Hit& from,
                               std::span<const glm::dvec3> directions, const AmbientReach& reach,
                               std::int64_t& traced) {
    const bool limited = std::isfinite(reach.range);
    std::vector<ShadowRay> asked;
    for (const glm::dvec3& w : directions)
        asked.push_back(ShadowRay::from(from, limited ? from.position + reach.range * w : w, !limited));
    std::vector<std::uint8_t> blocked(asked.size());
    tracer.occluded(asked, blocked);
    traced += std::int64_t(asked.size());
    std::vector<double> open(asked.size(), 1.0);
    for (std::size_t k = 0; k < asked.size(); ++k) {
        if (!blocked[k]) continue;
        open[k] = 0.0;
        if (!limited || !reach.smooth) continue;
        open[k] = openAt(distanceAlong(tracer, from, directions[k]), reach);
        ++traced;
    }
    return open;
}

void traceDirections(const RayTracer& tracer, const Hit& from, const AmbientRays& rays,
                     std::span<AmbientDirection> directions, std::int64_t& traced) {
    std::vector<glm::dvec3> asked;
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::dvec3& w = directions[i].direction;
        if (glm::dot(from.geometricNormal, w) < -tangent) continue;  // into the surface itself
        directions[i].open = 1.0;
        if (rays.nothingAbove) continue;
        asked.push_back(w);
        indices.push_back(i);
    }
    const std::vector<double> open = openShares(tracer, from, asked, rays.reach, traced);
    for (std::size_t k = 0; k < asked.size(); ++k) directions[indices[k]].open = open[k];
}

std::vector<AmbientDirection> castAmbientRays(const RayTracer& tracer, const Hit& from,
                                              const glm::dvec3& normal, const AmbientRays& rays,
                                              std::uint32_t seed, std::int64_t& traced) {
    const glm::dmat3 worldFromNormal = frameAround(normal);
    const bool cosine = rays.weighting == Weighting::cosine;
    std::vector<AmbientDirection> directions(std::size_t(rays.count));
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::dvec2 u = owenSobol(std::uint32_t(i), seed);
        directions[i].direction = worldFromNormal * (cosine ? cosineDirection(u) : uniformDirection(u));
    }
    traceDirections(tracer, from, rays, directions, traced);
    return directions;
}
// [end:rays]

// [begin:average]
AmbientValue averageOf(std::span<const AmbientDirection> directions) {
    AmbientValue sum{0.0, glm::dvec3(0.0)};
    for (const AmbientDirection& d : directions) {
        sum.visibility += d.open;
        sum.bent += d.open * d.direction;
    }
    const auto count = double(directions.size());
    return {sum.visibility / count, sum.bent / count};
}
// [end:average]

AmbientValue estimateAmbient(const RayTracer& tracer, const Hit& from, const glm::dvec3& normal,
                             const AmbientRays& rays, std::uint32_t seed, std::int64_t& traced) {
    return averageOf(castAmbientRays(tracer, from, normal, rays, seed, traced));
}

}  // namespace penumbra
