#include "chapters/04_pcf/filter_truth.h"

#include <algorithm>
#include <array>

#include "common/math/sampling.h"
#include "common/truth/exact_scene.h"
#include "common/truth/light_visibility.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

namespace {

constexpr int batch = 64;

/// Change whenever an answer changes: answers are kept on disk.
constexpr std::string_view algorithm = "2026-11 filter, 64 or 1024 rays";

/// Neighbouring triangles of one plane are only as coplanar as floats allow. A point of the plane of one,
/// lifted by this, is not under the other.
double roundingOf(const Scene& scene) {
    const glm::dvec3 largest = glm::max(glm::abs(scene.bounds.lower), glm::abs(scene.bounds.upper));
    return 8.0 * 0x1p-24 * std::max({largest.x, largest.y, largest.z});
}

/// In texels from the centre.
glm::dvec2 pointOf(const FilterKernel& kernel, const glm::dvec2& u) {
    return kernel.texels * (kernel.shape == FilterKernel::Shape::square ? u - 0.5 : concentricDisk(u));
}

}  // namespace

FilteredVisibility::FilteredVisibility(const RayTracer& tracer, const Light& light,
                                       const LightFrustum& frustum, const FilterKernel& kernel)
    : tracer_(tracer), light_(light), frustum_(frustum), kernel_(kernel), lift_(roundingOf(tracer.scene())) {}

// [begin:on-receiver]
glm::dvec3 FilteredVisibility::onReceiver(const Hit& hit, const glm::dvec2& uv) const {
    const Ray ray = frustum_.ray(uv);
    const double towards = glm::dot(hit.geometricNormal, ray.direction);
    // Rays that never reach the plane are cut off at the point's own depth.
    double t = frustum_.axisDistance(hit.position) - frustum_.near;
    if (towards < 0.0) {
        const double onPlane = glm::dot(hit.geometricNormal, hit.position - ray.origin) / towards;
        if (onPlane > 0.0) t = onPlane;
    }
    return ray.origin + t * ray.direction + lift_ * hit.geometricNormal;
}
// [end:on-receiver]

int FilteredVisibility::litOf(const Hit& hit, std::uint32_t seed, int first, int count) const {
    const glm::dvec4 strq = frustum_.textureFromWorld() * glm::dvec4(hit.position, 1.0);
    const glm::dvec2 centre = glm::dvec2(strq) / strq.w;
    const glm::dvec3 towardsLight = frustum_.orthographic ? -frustum_.ray(centre).direction : frustum_.eye;
    std::array<ShadowRay, batch> rays;
    std::array<std::uint8_t, batch> blocked;
    int lit = 0;
    for (int begin = first; begin < first + count; begin += batch) {
        for (int i = 0; i < batch; ++i) {
            const glm::dvec2 offset = pointOf(kernel_, owenSobol(std::uint32_t(begin + i), seed));
            const glm::dvec3 from = onReceiver(hit, centre + offset / double(kernel_.mapSize));
            rays[std::size_t(i)] =
                ShadowRay{from, towardsLight, hit.geometricNormal, 0.0, hit.triangle, frustum_.orthographic};
        }
        tracer_.occluded(rays, blocked, light_.part);
        lit += int(std::count(blocked.begin(), blocked.end(), 0));
    }
    return lit;
}

double FilteredVisibility::at(const Hit& hit, std::uint32_t seed) const {
    const int lit = litOf(hit, seed, 0, batch);
    if (lit == 0 || lit == batch) return lit == 0 ? 0.0 : 1.0;
    constexpr int all = 1024;
    return double(lit + litOf(hit, seed, batch, all - batch)) / all;
}

TruthImage filterTruth(const TruthRequest& request, const ShadowOptions& options,
                       const FilterKernel& kernel) {
    const Scene& scene = request.scene;
    const RayTracer& tracer = request.tracer;
    const Light& light = options.chosenLight(scene);
    // Depth does not matter here, so any format serves.
    const LightFrustum& frustum = options.frustum(scene, request.camera, request.size, DepthFormat::fixed24);
    ContentHash key;
    key.text(algorithm).geometry(scene).camera(request.camera).light(light).text(options.fit);
    key.number(std::int64_t(request.size.x)).number(std::int64_t(request.size.y));
    // Not the number of texels, but their share of the map: the same filter on a finer map has the same
    // answer.
    key.number(std::int64_t(kernel.shape)).number(kernel.texels / double(kernel.mapSize));
    return cachedTruth(key, [&] {
        const PrimaryHits primary = primaryHits(tracer, request.camera, request.size);
        const ExactScene exact(scene);
        const LightVisibility facing(exact, tracer, light, true);
        const FilteredVisibility visibility(tracer, light, frustum, kernel);
        const auto answerAt = [&](const Hit& hit, int x, int y, float* value) {
            const std::uint32_t seed = hashSeed(std::uint32_t(x), std::uint32_t(y));
            if (!facing.at(hit, seed).facing) return false;
            *value = float(visibility.at(hit, seed));
            return true;
        };
        TruthImage truth = surfaceTruth(primary, 1, answerAt, request.progress);
        truth.quantity = "visibility";
        truth.method = "ray traced";
        truth.against = "filter";
        return truth;
    });
}

std::optional<TruthImage> areaLightTruth(const TruthRequest& request, const ShadowOptions& options) {
    const Light& light = options.chosenLight(request.scene);
    if (request.view != "visibility" || light.type != LightType::area) return std::nullopt;
    return visibilityTruth(request.scene, request.tracer, request.camera, light, request.size, false,
                           request.progress);
}

}  // namespace penumbra
