// Which clusters can touch a frustum. Conservative: a cluster is dropped only if its box lies wholly outside
// one plane, so what is dropped cannot change a pixel.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "common/math/transforms.h"
#include "common/scene/scene.h"

namespace penumbra {

/// Half-spaces n.p + d >= 0 bounding {p : -w <= x,y,z <= w} of a clipFromWorld (Gribb & Hartmann 2001).
struct Frustum {
    std::array<glm::dvec4, 6> planes;
    explicit Frustum(const glm::dmat4& clipFromWorld, DepthRange range = DepthRange::standard);
    /// False only if the box is certainly outside (a relative margin of 1e-6 guards against rounding in float
    /// shaders).
    bool mayTouch(const Aabb& box) const;
};

/// Sorted indices into Scene::clusters.
struct VisibleClusters {
    std::vector<std::uint32_t> clusters;
    std::size_t triangles = 0;
    bool operator==(const VisibleClusters&) const = default;
};

/// Contiguous triangles that can go into one draw call.
struct IndexRange {
    std::uint32_t firstTriangle = 0;
    std::uint32_t triangleCount = 0;
};

VisibleClusters allClusters(const Scene& scene);
VisibleClusters visibleClusters(const Scene& scene, const Frustum& frustum);
/// Joins neighbouring visible clusters for which `accept(part)` holds.
std::vector<IndexRange> joinRanges(const Scene& scene, const VisibleClusters& visible,
                                   const std::function<bool(std::uint32_t part)>& accept);

}  // namespace penumbra
