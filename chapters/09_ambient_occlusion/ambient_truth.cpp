#include "chapters/09_ambient_occlusion/ambient_truth.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "chapters/09_ambient_occlusion/halves_differ.h"
#include "chapters/09_ambient_occlusion/open_planes.h"
#include "chapters/09_ambient_occlusion/pixel_rays.h"
#include "common/math/hemisphere.h"
#include "common/math/polygon.h"
#include "common/math/sampling.h"
#include "common/truth/exact_scene.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

namespace {

/// Change whenever an answer changes.
constexpr std::string_view algorithm = "2026-11 ambient, 1";

/// What is to be averaged over the directions: up to 3 channels.
using Quantity = std::function<glm::dvec3(std::span<const AmbientDirection>)>;

ContentHash keyOf(std::string_view quantity, const TruthRequest& request, const AmbientRays& rays) {
    ContentHash key;
    key.text(algorithm).text(quantity).geometry(request.scene).camera(request.camera);
    key.number(std::int64_t(request.size.x)).number(std::int64_t(request.size.y));
    key.number(std::int64_t(rays.count)).number(std::int64_t(rays.weighting == Weighting::uniform));
    key.number(rays.reach.range).number(std::int64_t(rays.reach.smooth));
    return key;
}

/// A sky is any function: its key are its values in 4096 directions.
ContentHash& addSky(ContentHash& key, const SkyLight& light) {
    constexpr int count = 4096;
    for (int i = 0; i < count; ++i) key.vector(light.sky.radiance(fibonacciSphere(i, count)));
    key.number(std::int64_t(light.sun.has_value()));
    if (light.sun) key.light(*light.sun);
    return key;
}

TruthImage traced(const TruthRequest& request, AmbientRays rays, int channels, const Quantity& quantity) {
    const PrimaryHits primary = primaryHits(request.tracer, request.camera, request.size);
    const OpenPlanes planes(request.scene);
    const int count = rays.count;
    rays.count = std::max(1, count / 2);
    HalvesDiffer halves(request.size.y);
    const auto answer = [&](const Hit& hit, int x, int y, float* value) {
        AmbientRays here = rays;
        here.nothingAbove = planes.nothingAbove(hit, rays.reach.range);
        std::int64_t traced = 0;
        std::array<glm::dvec3, 2> half{};
        for (std::uint32_t i = 0; i < 2; ++i)
            half[i] = quantity(castAmbientRays(request.tracer, hit, hit.shadingNormal, here,
                                               hashSeed(x, y, 0x7a11u + i), traced));
        halves.add(y, half[0] - half[1], channels);
        for (int c = 0; c < channels; ++c) value[c] = float(0.5 * (half[0][c] + half[1][c]));
        return true;
    };
    TruthImage truth = surfaceTruth(primary, channels, answer, request.progress);
    truth.method =
        fmt::format("ray traced, {} rays a pixel, standard error {:.1e}", count, halves.standardError());
    return truth;
}

TruthImage exactly(const TruthRequest& request) {
    const PrimaryHits primary = primaryHits(request.tracer, request.camera, request.size);
    const ExactAmbient exact(request.scene);
    const auto answer = [&](const Hit& hit, int, int, float* value) {
        *value = float(exact.visibility(hit, hit.shadingNormal));
        return true;
    };
    TruthImage truth = surfaceTruth(primary, 1, answer, request.progress);
    truth.method = "closed form";
    return truth;
}

void describe(TruthImage& truth, const char* quantity, const AmbientRays& rays) {
    truth.quantity = quantity;
    truth.against = rays.weighting == Weighting::cosine ? "sky, cosine weighting" : "sky, uniform weighting";
    if (std::isfinite(rays.reach.range))
        truth.against +=
            fmt::format(", {} range of {} m", rays.reach.smooth ? "smooth" : "hard", float(rays.reach.range));
}

}  // namespace

TruthImage ambientTruth(const TruthRequest& request, const AmbientRays& rays) {
    const bool closed = rays.weighting == Weighting::cosine && !std::isfinite(rays.reach.range) &&
                        request.scene.triangleCount() <= exactTriangles;
    return cachedTruth(keyOf(closed ? "ambient, exactly" : "ambient", request, rays), [&] {
        TruthImage truth = closed ? exactly(request) : traced(request, rays, 1, [](const auto& directions) {
            return glm::dvec3(averageOf(directions).visibility);
        });
        describe(truth, "ambient visibility", rays);
        return truth;
    });
}

TruthImage bentVectorTruth(const TruthRequest& request, const AmbientRays& rays) {
    return cachedTruth(keyOf("bent vector", request, rays), [&] {
        TruthImage truth =
            traced(request, rays, 3, [](const auto& directions) { return averageOf(directions).bent; });
        describe(truth, "bent vector", rays);
        return truth;
    });
}

TruthImage skyIrradianceTruth(const TruthRequest& request, const AmbientRays& rays, const SkyLight& light) {
    ContentHash key = keyOf("irradiance of a sky", request, rays);
    return cachedTruth(addSky(key, light), [&] {
        TruthImage truth = traced(request, rays, 3, [&](const auto& directions) {
            glm::dvec3 sum(0.0);
            for (const AmbientDirection& d : directions) sum += d.open * light.sky.radiance(d.direction);
            return std::numbers::pi * sum / double(directions.size());
        });
        if (light.sun) {
            const PrimaryHits primary = primaryHits(request.tracer, request.camera, request.size);
            surfaceTruth(primary, 3, [&](const Hit& hit, int x, int y, float* value) {
                const glm::dvec3 sun = sunlight(request.tracer, *light.sun, hit, hit.shadingNormal);
                for (int c = 0; c < 3; ++c) {
                    truth.value.at(x, y, c) += float(std::numbers::pi * sun[c]);
                    value[c] = 0.0f;
                }
                return true;
            });
        }
        describe(truth, "irradiance", rays);
        return truth;
    });
}

// [begin:exact]
struct ExactAmbient::State {
    explicit State(const Scene& scene) : exact(scene), box(scene.bounds) {
        const glm::dvec3 room(1.0 + 2.0 * box.radius());
        box.lower -= room;
        box.upper += room;
    }
    ExactScene exact;
    Aabb box;  ///< around the scene: the sky
};

double ExactAmbient::visibility(const Hit& hit, const glm::dvec3& normal) const {
    const Aabb& box = state_->box;
    double sum = 0.0;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        glm::dvec3 corner = face % 2 ? box.upper : box.lower, alongU(0.0), alongV(0.0);
        const double direction = face % 2 ? -1.0 : 1.0;
        alongU[u] = direction * (box.upper[u] - box.lower[u]);
        alongV[v] = box.upper[v] - box.lower[v];
        corner[v] = box.lower[v];
        corner[u] = direction > 0.0 ? box.lower[u] : box.upper[u];
        const std::array<glm::dvec3, 4> corners{corner, corner + alongU, corner + alongU + alongV,
                                                corner + alongV};
        // What is below the surface itself is no sky, even if the shading normal says otherwise.
        const Polygon3 sky = clip(Polygon3(corners), [&](const glm::dvec3& p) {
            return glm::dot(hit.geometricNormal, p - hit.position);
        });
        if (sky.empty()) continue;
        sum += state_->exact.visibleFormFactor(hit.position, normal, sky.span(), noPart, hit.triangle);
    }
    return sum;
}
// [end:exact]

ExactAmbient::ExactAmbient(const Scene& scene) : state_(std::make_unique<State>(scene)) {}
ExactAmbient::~ExactAmbient() = default;

}  // namespace penumbra
