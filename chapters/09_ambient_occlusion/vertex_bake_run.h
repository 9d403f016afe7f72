// A bake under way. Internal to vertex_bake.h.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/shared_rays.h"
#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/09_ambient_occlusion/vertex_bake_neighbours.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/vertex_bake_rays.h"

namespace penumbra {

/// The points, and what is known about them. Keeps references to all that it is given.
class Bake {
 public:
    Bake(const Scene& scene, const RayBundle& bundle, const BakePoints& points, const BakeSettings& settings,
         const ProgressCallback& progress);

    /// settings.rays.count rays at every point.
    std::vector<AmbientValue> alone();
    /// Fewer, with the help of the neighbours.
    std::vector<AmbientValue> shared(const PointNeighbours& neighbours);
    BakeWork work() const;

 private:
    void findOpen();
    /// Is it known that point `i` sees the whole sky? Without the skip that is not believed: all rays are
    /// traced, and one that is blocked makes it a point like any other.
    bool seesAll(std::size_t i, int count, std::int64_t& traced);
    void firstRays();
    void secondRays(std::span<const float> variances, float threshold);
    void askNeighbours(const SharedRays& sharing, float threshold, std::vector<float>& variances);
    void refine(float threshold);
    AmbientValue result(std::size_t i) const;

    /// `body(i, traced)` for each point, on all cores; the progress goes from `from` to `to`.
    template <class Body>
    void forEachPoint(double from, double to, const Body& body);
    RaySums trace(std::size_t i, int count, std::uint32_t round, std::int64_t& traced,
                  LatticePart part = LatticePart::whole) const;

    const Scene& scene_;
    const RayBundle& bundle_;
    const BakePoints& points_;
    const BakeSettings& settings_;
    const ProgressCallback& progress_;
    double reach_;
    std::vector<std::uint8_t> open_;  ///< 1: sees the whole sky, no ray needed
    std::vector<OwnEstimate> own_;
    std::vector<NeighbourEstimate> others_;
    int firstCount_ = 0;
    std::vector<int> counts_;  ///< rays of each point so far
    std::atomic<std::int64_t> rays_{0};
    std::int64_t bytes_ = 0;
};

}  // namespace penumbra
