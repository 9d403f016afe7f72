#include "chapters/09_ambient_occlusion/open_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/truth/surface_hit.h"

namespace penumbra {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Is `p` above the plane through `foot` with the unit normal `n`, by more than rounding? The bound counts 4
/// roundings of the normal, 1 of the difference and 3 of the product, each 2^-53 of the magnitudes, twice.
bool above(const glm::dvec3& p, const glm::dvec3& foot, const glm::dvec3& n) {
    const double bound = 16.0 * 0x1p-53 * glm::dot(glm::abs(n), glm::abs(p) + glm::abs(foot));
    return glm::dot(n, p - foot) > bound;
}

}  // namespace

OpenPlanes::OpenPlanes(const Scene& scene)
    : scene_(scene), boxes_(scene.triangleCount()), known_(2 * scene.triangleCount()) {
    for (std::uint32_t t = 0; t < boxes_.size(); ++t)
        for (const glm::dvec3& corner : cornersOf(scene, t)) boxes_[t].extend(corner);
}

// [begin:nothing-above]
/// Does a triangle of the cluster rise above the plane of `from`, and is it within range?
bool OpenPlanes::reachesAbove(const Cluster& cluster, const Hit& from, double range) const {
    const glm::dvec3 foot = cornersOf(scene_, from.triangle)[0];
    if (!above(cluster.bounds.farthestAlong(from.geometricNormal), foot, from.geometricNormal)) return false;
    if (cluster.bounds.squaredDistance(from.position) > range * range) return false;
    // The box does, but does a triangle?
    for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
        if (boxes_[t].squaredDistance(from.position) > range * range) continue;
        for (const glm::dvec3& corner : cornersOf(scene_, t))
            if (above(corner, foot, from.geometricNormal)) return true;
    }
    return false;
}
// [end:nothing-above]

bool OpenPlanes::nothingAboveTriangle(const Hit& from) const {
    std::atomic<Known>& known = known_[2 * std::size_t(from.triangle) + (from.fromBehind ? 1 : 0)];
    if (known.load(std::memory_order_relaxed) == Known::notYet) {
        bool open = true;
        for (const Cluster& cluster : scene_.clusters) open = open && !reachesAbove(cluster, from, infinite);
        known.store(open ? Known::open : Known::notOpen, std::memory_order_relaxed);
    }
    return known.load(std::memory_order_relaxed) == Known::open;
}

bool OpenPlanes::nothingAbove(const Hit& from, double range) const {
    if (nothingAboveTriangle(from)) return true;
    if (!std::isfinite(range)) return false;
    return std::none_of(scene_.clusters.begin(), scene_.clusters.end(),
                        [&](const Cluster& cluster) { return reachesAbove(cluster, from, range); });
}

}  // namespace penumbra
