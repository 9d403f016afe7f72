// Triangles of a part, reordered so that neighbours in space are neighbours in memory, and cut into clusters.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra {

constexpr std::uint32_t maxClusterTriangles = 256;

/// Reorders the triangles of `indices` (3 per triangle, into `positions`) and returns the sizes, in
/// triangles, of the clusters that follow one another in it: each 1 to maxClusterTriangles, and at most one
/// of them not full. Halves the triangles by their centres along the longest axis until they fit; inside a
/// cluster, meshoptimizer orders them for the vertex cache (T. Forsyth, "Linear-Speed Vertex Cache
/// Optimisation", 2006). Deterministic: the result depends on the input alone. Winding is kept.
std::vector<std::uint32_t> clusterTriangles(std::span<const glm::vec3> positions,
                                            std::vector<std::uint32_t>& indices);

}  // namespace penumbra
