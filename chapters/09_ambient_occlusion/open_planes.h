// Where no ray is needed: points above whose surface there is nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "common/scene/scene.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

/// Finds the points whose rays cannot meet anything: no surface within range rises above the plane of their
/// triangle. Exact, never the other way round: what only touches the plane counts as below, as it does for
/// the ray tracer (segment_test.h). Without a range the answer is that of the whole triangle and remembered.
/// All queries may run on many threads.
class OpenPlanes {
 public:
    /// Keeps a reference to `scene`.
    explicit OpenPlanes(const Scene& scene);
    /// `range` metres, may be infinite. The side is that of from.geometricNormal.
    bool nothingAbove(const Hit& from, double range) const;

 private:
    enum class Known : std::uint8_t { notYet, open, notOpen };

    bool nothingAboveTriangle(const Hit& from) const;
    bool reachesAbove(const Cluster& cluster, const Hit& from, double range) const;

    const Scene& scene_;
    std::vector<Aabb> boxes_;                        ///< of the triangles
    mutable std::vector<std::atomic<Known>> known_;  ///< front and back of each triangle
};

}  // namespace penumbra
