// Coplanar triangles merged into few convex polygons.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra {

/// A polygon as indices into a list of points, counter-clockwise.
using IndexPolygon = std::vector<std::uint32_t>;

/// Joins neighbours across shared edges while the union stays convex with at most `maxCorners` corners (the
/// essential diagonals of Hertel & Mehlhorn, FCT 1983), then drops corners in the middle of straight edges.
/// `points` in the plane, `triangles` counter-clockwise, sharing edges by index. The union covers exactly
/// what the triangles cover.
std::vector<IndexPolygon> mergeConvex(std::span<const glm::dvec2> points,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      std::size_t maxCorners);

}  // namespace penumbra
