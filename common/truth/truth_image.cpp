#include "common/truth/truth_image.h"

#include <array>
#include <atomic>
#include <cmath>

#include "common/math/sampling.h"
#include "common/truth/exact_scene.h"
#include "common/truth/light_visibility.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

namespace {

/// Change whenever an answer changes, so that answers computed by older code are not found again.
constexpr std::string_view algorithm = "2026-11 exact segments and cones, 4";

/// Do two hits lie on one smooth piece of surface? Same part, same side, normals within 25 degrees (a curved
/// surface of 16 facets passes, a crease does not), and neither much off the other's tangent plane (a step in
/// depth would be).
bool smoothlyConnected(const Hit& a, const Hit& b) {
    if (!a.valid || !b.valid) return a.valid == b.valid;
    if (a.part != b.part || glm::dot(a.geometricNormal, b.geometricNormal) < 0.9) return false;
    const glm::dvec3 step = b.position - a.position;
    const double allowed = 0.25 * glm::length(step);
    return std::abs(glm::dot(a.geometricNormal, step)) <= allowed &&
           std::abs(glm::dot(b.geometricNormal, step)) <= allowed;
}

}  // namespace

TruthImage surfaceTruth(const PrimaryHits& primary, int channels, const SurfaceAnswer& answer,
                        const ProgressCallback& progress) {
    TruthImage truth;
    truth.value = FloatImage(primary.size.x, primary.size.y, channels);
    truth.mask = FloatImage(primary.size.x, primary.size.y, 1);
    std::atomic<std::size_t> background = 0, straddling = 0, facingAway = 0;
    const glm::ivec2 size = primary.size;
    const auto row = [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = std::size_t(y) * size.x + x;
            if (!primary.hits[i].valid) {
                ++background;
            } else if (primary.straddling[i]) {
                ++straddling;
            } else if (!answer(primary.hits[i], x, y, &truth.value.at(x, y))) {
                ++facingAway;
            } else {
                truth.mask.at(x, y) = 1.0f;
            }
        }
    };
    parallelRows(size.y, row, progress ? [&](double f) { progress(0.1 + 0.9 * f); } : ProgressCallback{});
    truth.background = background;
    truth.straddling = straddling;
    truth.facingAway = facingAway;
    return truth;
}

namespace {

std::string methodName(std::size_t rayTraced) {
    return rayTraced == 0 ? "closed form"
                          : "closed form; ray traced in " + std::to_string(rayTraced) + " pixels";
}

ProgressCallback firstTenth(const ProgressCallback& progress) {
    return progress ? [&progress](double f) { progress(0.1 * f); } : ProgressCallback{};
}

ContentHash keyOf(std::string_view quantity, const Scene& scene, const Camera& camera,
                  std::span<const Light> lights, const glm::ivec2& size, bool asPoint) {
    ContentHash key;
    key.text(algorithm).text(quantity).geometry(scene).camera(camera);
    key.number(std::int64_t(size.x)).number(std::int64_t(size.y)).number(std::int64_t(asPoint));
    for (const Light& light : lights) key.light(light);
    return key;
}

bool isAreaTruth(const Light& light, bool asPoint) {
    return light.type == LightType::area && !asPoint;
}

}  // namespace

void faceTheEye(Hit& hit, const Ray& ray) {
    if (!hit.valid || glm::dot(hit.geometricNormal, ray.direction) <= 0.0) return;
    hit.fromBehind = true;
    hit.geometricNormal = -hit.geometricNormal;
    hit.shadingNormal = -hit.shadingNormal;
}

PrimaryHits primaryHits(const RayTracer& tracer, const Camera& camera, const glm::ivec2& size,
                        const ProgressCallback& progress) {
    const std::size_t columns = std::size_t(size.x) + 1;
    std::vector<Hit> corners(columns * (std::size_t(size.y) + 1));
    const auto cornerRow = [&](int y) {
        for (int x = 0; x <= size.x; ++x)
            corners[std::size_t(y) * columns + x] = tracer.nearest(cameraRay(camera, {x, y}, size));
    };
    parallelRows(size.y + 1, cornerRow, progress ? [&](double f) { progress(0.5 * f); } : ProgressCallback{});

    PrimaryHits result{size, std::vector<Hit>(std::size_t(size.x) * size.y),
                       std::vector<std::uint8_t>(std::size_t(size.x) * size.y)};
    const auto centreRow = [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = std::size_t(y) * size.x + x;
            const Ray ray = cameraRay(camera, {x + 0.5, y + 0.5}, size);
            Hit& hit = result.hits[i] = tracer.nearest(ray);
            const std::size_t corner = std::size_t(y) * columns + x;
            for (const std::size_t k : {corner, corner + 1, corner + columns, corner + columns + 1})
                result.straddling[i] |= smoothlyConnected(hit, corners[k]) ? 0 : 1;
            faceTheEye(hit, ray);
        }
    };
    parallelRows(size.y, centreRow,
                 progress ? [&](double f) { progress(0.5 + 0.5 * f); } : ProgressCallback{});
    return result;
}

TruthImage visibilityTruth(const Scene& scene, const RayTracer& tracer, const Camera& camera,
                           const Light& light, const glm::ivec2& size, bool asPoint,
                           const ProgressCallback& progress) {
    return cachedTruth(keyOf("visibility", scene, camera, std::span(&light, 1), size, asPoint), [&] {
        const PrimaryHits primary = primaryHits(tracer, camera, size, firstTenth(progress));
        const ExactScene exact(scene);
        const LightVisibility visibility(exact, tracer, light, asPoint);
        std::atomic<std::size_t> rayTraced = 0;
        const auto answerAt = [&](const Hit& hit, int x, int y, float* value) {
            const LightAnswer answer = visibility.at(hit, hashSeed(std::uint32_t(x), std::uint32_t(y)));
            *value = float(answer.visible);
            rayTraced += answer.rayTraced;
            return answer.facing;
        };
        TruthImage truth = surfaceTruth(primary, 1, answerAt, progress);
        truth.quantity = "visibility";
        truth.method = methodName(rayTraced);
        truth.against = isAreaTruth(light, asPoint) ? "area light" : "point light";
        return truth;
    });
}

TruthImage irradianceTruth(const Scene& scene, const RayTracer& tracer, const Camera& camera,
                           std::span<const Light> lights, const glm::ivec2& size, bool asPoint,
                           const ProgressCallback& progress) {
    return cachedTruth(keyOf("irradiance", scene, camera, lights, size, asPoint), [&] {
        const PrimaryHits primary = primaryHits(tracer, camera, size, firstTenth(progress));
        const ExactScene exact(scene);
        std::vector<LightVisibility> visibility;
        for (const Light& light : lights) visibility.emplace_back(exact, tracer, light, asPoint);
        std::atomic<std::size_t> rayTraced = 0;
        const auto answerAt = [&](const Hit& hit, int x, int y, float* value) {
            glm::dvec3 sum(0.0);
            bool traced = false;
            for (std::size_t k = 0; k < visibility.size(); ++k) {
                const auto seed = hashSeed(std::uint32_t(x), std::uint32_t(y), std::uint32_t(k));
                const LightAnswer answer = visibility[k].at(hit, seed);
                sum += answer.irradiance;
                traced = traced || answer.rayTraced;
            }
            for (int c = 0; c < 3; ++c) value[c] = float(sum[c]);
            rayTraced += traced;
            return true;
        };
        TruthImage truth = surfaceTruth(primary, 3, answerAt, progress);
        truth.quantity = "irradiance";
        truth.method = methodName(rayTraced);
        truth.against = lights.size() > 1                 ? "all lights"
                        : isAreaTruth(lights[0], asPoint) ? "area light"
                                                          : "point light";
        return truth;
    });
}

}  // namespace penumbra
