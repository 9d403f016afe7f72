#include "common/truth/ray_tracer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <optional>

#include "common/truth/embree_scene.h"
#include "common/truth/exact_scene.h"
#include "common/truth/shadow_packet.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

struct RayTracer::State {
    explicit State(const Scene& s) : scene(s), reach(largestCoordinate(s.bounds)) {}

    const Scene& scene;
    const double reach;  ///< largest coordinate of the scene, metres
    std::once_flag embreeOnce, exactOnce;
    std::optional<EmbreeScene> embree;
    std::optional<ExactScene> exact;

    const EmbreeScene& built() {
        std::call_once(embreeOnce, [this] { embree.emplace(scene); });
        return *embree;
    }
    IgnoredTriangles ignored(int part) const;
    bool occludedExactly(const ShadowRay& ray, int ignorePart, double part);
    bool settle(const ShadowRay& ray, bool doubtful, int ignorePart);
};

IgnoredTriangles RayTracer::State::ignored(int part) const {
    if (part < 0 || std::size_t(part) >= scene.parts.size()) return {};
    const Part& p = scene.parts[std::size_t(part)];
    return {p.firstTriangle, p.firstTriangle + p.triangleCount};
}

/// The slow answer, wholly in double, for the few rays that float cannot settle; about the first `part` of
/// the ray.
bool RayTracer::State::occludedExactly(const ShadowRay& ray, int ignorePart, double part) {
    std::call_once(exactOnce, [this] { exact.emplace(scene); });
    glm::dvec3 target = ray.target;
    if (ray.towardsInfinity && part >= 1.0) {
        const double beyond = 4.0 * (reach + glm::length(ray.origin)) + 1.0;
        target = ray.origin + beyond * glm::normalize(ray.target);
    } else if (part < 1.0) {
        target = ray.origin + part * (ray.towardsInfinity ? ray.target : ray.target - ray.origin);
    }
    return exact->occluded(ray.origin, ray.triangle, target, ignorePart);
}

/// A ray that Embree finds free, but is doubtful or begins near an edge of its own triangle.
bool RayTracer::State::settle(const ShadowRay& ray, bool doubtful, int ignorePart) {
    if (doubtful) return occludedExactly(ray, ignorePart, 1.0);
    // Only the first stretch is in doubt: 4096 ulps, a short walk through the hierarchy.
    const glm::dvec3 whole = ray.towardsInfinity ? ray.target : ray.target - ray.origin;
    const double stretch = 4096.0 * ulpOf(ray, reach) / glm::length(whole);
    return occludedExactly(ray, ignorePart, std::min(1.0, stretch));
}

RayTracer::RayTracer(const Scene& scene) : state_(std::make_unique<State>(scene)) {}
RayTracer::~RayTracer() = default;
const Scene& RayTracer::scene() const {
    return state_->scene;
}

Hit RayTracer::nearest(const Ray& ray, int ignorePart) const {
    const std::optional<std::uint32_t> found = state_->built().nearest(ray, state_->ignored(ignorePart));
    if (!found) return {};
    return surfaceHit(state_->scene, *found, exactBarycentrics(ray, cornersOf(state_->scene, *found)));
}

void RayTracer::occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                         int ignorePart) const {
    const EmbreeScene& embree = state_->built();
    const IgnoredTriangles ignored = state_->ignored(ignorePart);
    ShadowPacket packet;
    for (std::size_t first = 0; first < rays.size(); first += ShadowPacket::size) {
        const auto some = rays.subspan(first, std::min<std::size_t>(ShadowPacket::size, rays.size() - first));
        roundToFloat(some, state_->reach, packet);
        const PacketAnswer answer = embree.occluded(some, packet, ignored);
        for (std::size_t i = 0; i < some.size(); ++i) blocked[first + i] = answer.blocked >> i & 1u;
        std::uint32_t unsettled = (answer.doubtful | packet.nearOwnEdge) & ~answer.blocked;
        for (; unsettled != 0; unsettled &= unsettled - 1) {
            const auto i = std::size_t(std::countr_zero(unsettled));
            blocked[first + i] = state_->settle(some[i], answer.doubtful >> i & 1u, ignorePart) ? 1 : 0;
        }
    }
}

bool RayTracer::occluded(const Hit& from, const glm::dvec3& target, int ignorePart) const {
    const ShadowRay ray = ShadowRay::from(from, target);
    std::uint8_t blocked = 0;
    occluded(std::span(&ray, 1), std::span(&blocked, 1), ignorePart);
    return blocked != 0;
}

bool RayTracer::occludedTowards(const Hit& from, const glm::dvec3& direction, int ignorePart) const {
    const ShadowRay ray = ShadowRay::from(from, direction, true);
    std::uint8_t blocked = 0;
    occluded(std::span(&ray, 1), std::span(&blocked, 1), ignorePart);
    return blocked != 0;
}

}  // namespace penumbra
