#include "chapters/11_bent_normals/irradiance_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_truth.h"
#include "chapters/09_ambient_occlusion/halves_differ.h"
#include "common/math/hemisphere.h"
#include "common/math/sampling.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

namespace {

using std::numbers::pi;

/// Seeds of the exact answer are not those of the estimate: it would agree with its own noise.
constexpr std::uint32_t truthSeed = 0x7275u;

TruthImage compute(const TruthRequest& request, const Sky& sky, const SkyDensity& density,
                   const AmbientRays& rays) {
    const PrimaryHits primary = primaryHits(request.tracer, request.camera, request.size);
    HalvesDiffer halves(request.size.y);
    const auto answer = [&](const Hit& hit, int x, int y, float* value) {
        const std::uint32_t seed = hashSeed(std::uint32_t(x), std::uint32_t(y), truthSeed);
        const auto half = [&](std::uint32_t i) {
            return tracedIrradiance(request.tracer, hit, sky, density, rays.count / 2, hashSeed(seed, i),
                                    rays.reach);
        };
        const glm::dvec3 first = half(1), second = half(2);
        halves.add(y, first - second, 3);
        const glm::vec3 E(0.5 * (first + second));
        std::copy_n(&E.x, 3, value);
        return true;
    };
    TruthImage truth = surfaceTruth(primary, 3, answer, request.progress);
    truth.quantity = "irradiance";
    truth.method =
        fmt::format("ray traced, {} rays a pixel, standard error {:.1e}", rays.count, halves.standardError());
    truth.against = "sky";
    return truth;
}

}  // namespace

// [begin:traced]
glm::dvec3 tracedIrradiance(const RayTracer& tracer, const Hit& from, const Sky& sky,
                            const SkyDensity& density, int rays, std::uint32_t seed,
                            const AmbientReach& reach) {
    const glm::dvec3& n = from.shadingNormal;
    const glm::dmat3 worldFromNormal = frameAround(n);
    const int byCosine = density.isBlack() ? rays : (rays + 1) / 2;
    std::vector<glm::dvec3> asked, arriving;
    for (int i = 0; i < rays; ++i) {
        const bool cosine = i < byCosine;
        const glm::dvec2 u =
            owenSobol(std::uint32_t(cosine ? i : i - byCosine), hashSeed(seed, std::uint32_t(cosine)));
        const glm::dvec3 w = cosine ? worldFromNormal * cosineDirection(u) : density.direction(u);
        const double facing = glm::dot(n, w);
        if (facing <= 0.0 || glm::dot(from.geometricNormal, w) <= 0.0) continue;
        // Rays per steradian, of either kind.
        const double both = byCosine * facing / pi + (rays - byCosine) * density.at(w);
        asked.push_back(w);
        arriving.push_back(sky.radiance(w) * (facing / both));
    }
    std::int64_t traced = 0;
    const std::vector<double> open = openShares(tracer, from, asked, reach, traced);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < asked.size(); ++i) sum += open[i] * arriving[i];
    return sum;
}
// [end:traced]

TruthImage irradianceTruth(const TruthRequest& request, const Sky& sky, const AmbientRays& rays) {
    const SkyDensity density(sampleSky([&](const glm::dvec3& w) { return sky.radiance(w); }));
    ContentHash key;
    key.text("irradiance by the sky's density, 2").geometry(request.scene).camera(request.camera);
    key.number(std::int64_t(request.size.x))
        .number(std::int64_t(request.size.y))
        .number(std::int64_t(rays.count));
    key.number(rays.reach.range).number(std::int64_t(rays.reach.smooth));
    key.array(std::span<const double>(density.cells()));
    return cachedTruth(key, [&] { return compute(request, sky, density, rays); });
}

TruthImage bentNormalTruth(const TruthRequest& request, const AmbientRays& rays) {
    TruthImage truth = bentVectorTruth(request, rays);
    for (std::size_t i = 0; i < truth.mask.values.size(); ++i) {
        if (truth.mask.values[i] == 0.0f) continue;
        float* texel = &truth.value.values[3 * i];
        const glm::vec3 bent(texel[0], texel[1], texel[2]);
        const float length = glm::length(bent);
        truth.mask.values[i] = length > 0.0f ? 1.0f : 0.0f;
        const glm::vec3 shown = 0.5f + 0.5f * bent / std::max(length, 1e-30f);
        std::copy_n(&shown.x, 3, texel);
    }
    truth.quantity = "bent normal, as a colour";
    return truth;
}

}  // namespace penumbra
