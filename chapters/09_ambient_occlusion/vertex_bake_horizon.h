// Is there anything above the tangent plane of a point? If not, it sees the whole sky, and no ray is needed.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "common/math/aabb.h"
#include "common/scene/scene.h"

namespace penumbra {

class Horizon {
 public:
    /// Keeps a reference to `scene`. Boxes around runs of 16 triangles in Morton order, around 16 of those,
    /// and so on.
    explicit Horizon(const Scene& scene);

    /// Does a triangle within `range` metres of where a ray of `point` begins (PointFan) reach above the
    /// point's tangent plane, by more than tangentTolerance? If not, no ray is blocked. `points`: of the same
    /// scene.
    bool anythingAbove(const BakePoints& points, const BakePoint& point, double range) const;

    std::size_t bytes() const;

 private:
    struct Query;
    void sortTriangles();
    void chooseScouts();
    bool above(const Query& query, std::size_t level, std::size_t box) const;
    bool triangleAbove(const Query& query, std::size_t triangle) const;

    const Scene& scene_;
    std::vector<std::uint32_t> triangles_;   ///< in Morton order of their centroids
    std::vector<glm::vec3> scouts_;          ///< some vertices: most points find one of them above
    std::vector<std::vector<Aabb>> levels_;  ///< the lowest around triangles; the highest has at most 16
    double reach_, tolerance_;               ///< metres
};

}  // namespace penumbra
