// The flat polygons of a part, and the parallelogram around each.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra {

/// Triangles that are connected by edges, lie in one plane, and have its normal as shading normal.
struct FlatPolygon {
    std::vector<std::uint32_t> triangles;  ///< ascending: indices into Scene::indices / 3
    glm::dvec3 normal{0.0};                ///< unit, by the triangles' winding
    double area = 0.0;                     ///< m^2
};

/// All flat polygons of a part of at least `minimumArea`, m^2. Vertices of equal position are one. "In one
/// plane" is: within ten times the rounding of the floats (1e-6 of the part's extent); "its normal": within a
/// thousandth of a radian.
std::vector<FlatPolygon> flatPolygons(const Scene& scene, const Part& part, double minimumArea);

/// corner, u edge, v edge, counter-clockwise about `normal`: the convex hull of the points itself if that is
/// a parallelogram (then to the bit), else the smallest rectangle around them in the plane through the first.
std::array<glm::dvec3, 3> parallelogramAround(std::span<const glm::dvec3> points, const glm::dvec3& normal);

}  // namespace penumbra
