#include "common/scene/culling.h"

#include <cmath>

namespace penumbra {
namespace {

glm::dvec4 row(const glm::dmat4& m, int i) {
    return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

}  // namespace

Frustum::Frustum(const glm::dmat4& clipFromWorld, DepthRange range) {
    const glm::dvec4 x = row(clipFromWorld, 0), y = row(clipFromWorld, 1);
    const glm::dvec4 z = row(clipFromWorld, 2), w = row(clipFromWorld, 3);
    // standard: -w <= z <= w. reversed: 0 (far) <= z <= w (near); an infinite far plane is then z = 0 * p +
    // near > 0: no limit.
    const glm::dvec4 lowZ = range == DepthRange::standard ? w + z : z;
    planes = {w + x, w - x, w + y, w - y, lowZ, w - z};
}

bool Frustum::mayTouch(const Aabb& box) const {
    if (box.empty()) return false;
    for (const glm::dvec4& plane : planes) {
        const glm::dvec3 n(plane);
        // The corner farthest along n; if even that one is outside, the box is.
        const glm::dvec3 p(n.x > 0.0 ? box.upper.x : box.lower.x, n.y > 0.0 ? box.upper.y : box.lower.y,
                           n.z > 0.0 ? box.upper.z : box.lower.z);
        const double terms = glm::dot(glm::abs(n), glm::abs(p)) + std::abs(plane.w);
        if (glm::dot(n, p) + plane.w < -1e-6 * terms) return false;
    }
    return true;
}

VisibleClusters allClusters(const Scene& scene) {
    VisibleClusters visible;
    visible.clusters.reserve(scene.clusters.size());
    for (std::uint32_t i = 0; i < scene.clusters.size(); ++i) visible.clusters.push_back(i);
    visible.triangles = scene.triangleCount();
    return visible;
}

VisibleClusters visibleClusters(const Scene& scene, const Frustum& frustum) {
    VisibleClusters visible;
    for (std::uint32_t i = 0; i < scene.clusters.size(); ++i) {
        const Cluster& cluster = scene.clusters[i];
        if (!frustum.mayTouch(scene.parts[cluster.part].bounds)) {
            // The whole part is outside: on to the first cluster of the next.
            while (i + 1 < scene.clusters.size() && scene.clusters[i + 1].part == cluster.part) ++i;
            continue;
        }
        if (!frustum.mayTouch(cluster.bounds)) continue;
        visible.clusters.push_back(i);
        visible.triangles += cluster.triangleCount;
    }
    return visible;
}

std::vector<IndexRange> joinRanges(const Scene& scene, const VisibleClusters& visible,
                                   const std::function<bool(std::uint32_t part)>& accept) {
    std::vector<IndexRange> ranges;
    std::uint32_t askedPart = ~0u;
    bool accepted = false;
    for (const std::uint32_t index : visible.clusters) {
        const Cluster& cluster = scene.clusters[index];
        if (cluster.part != askedPart) {
            askedPart = cluster.part;
            accepted = accept(askedPart);
        }
        if (!accepted) continue;
        if (!ranges.empty() &&
            ranges.back().firstTriangle + ranges.back().triangleCount == cluster.firstTriangle) {
            ranges.back().triangleCount += cluster.triangleCount;
        } else {
            ranges.push_back({cluster.firstTriangle, cluster.triangleCount});
        }
    }
    return ranges;
}

}  // namespace penumbra
