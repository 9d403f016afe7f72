// Which points of a bake are next to one another along the surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "common/scene/scene.h"

namespace penumbra {

struct PointNeighbours {
    std::vector<std::uint32_t> first;  ///< one more than there are points
    std::vector<std::uint32_t> list;   ///< those of point i: [first[i], first[i + 1]), ascending

    std::span<const std::uint32_t> of(std::size_t point) const {
        return {list.data() + first[point], first[point + 1] - first[point]};
    }
    std::size_t bytes() const { return (first.size() + list.size()) * sizeof(std::uint32_t); }
};

/// Vertices are neighbours if a triangle has both as corners. Vertices that were merged count as one, so a
/// seam between texture charts is no border; a crease, where the normals differ, is one.
PointNeighbours vertexNeighbours(const Scene& scene, const BakePoints& points);
/// Triangles are neighbours if they share a corner; `points` are of trianglePoints.
PointNeighbours triangleNeighbours(const Scene& scene, const BakePoints& points);

}  // namespace penumbra
