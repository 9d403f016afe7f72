// Does any of many triangles reach in? In a few box tests.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "chapters/08_accumulation/reach.h"

namespace penumbra {

/// Boxes over runs of neighbouring triangles, and boxes over those, two by two. A scene's triangles lie near
/// one another in memory when they do in space (clusters.h), so no sorting is needed. Built in O(n); then any
/// number of threads may ask.
class OccluderTree {
 public:
    /// Keeps a reference to the triangles.
    explicit OccluderTree(std::span<const Triangle> triangles);

    /// False only if all of them miss.
    bool reachesInto(const Reach& reach) const { return !triangles_.empty() && reachesInto(reach, 1); }

 private:
    bool reachesInto(const Reach& reach, std::size_t node) const;

    std::span<const Triangle> triangles_;
    std::size_t leaves_ = 1;   ///< a power of two
    std::vector<Aabb> boxes_;  ///< children of node i are 2i and 2i + 1; the leaves come last
};

}  // namespace penumbra
