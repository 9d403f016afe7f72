// Vertex values whose linear interpolation comes nearest to samples all over the surface (Kavan, Bargteil &
// Sloan, "Least Squares Vertex Baking", 2011, Eurographics Symposium on Rendering).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra {

/// A value somewhere on a triangle.
struct SurfaceSample {
    std::uint32_t triangle = 0;
    glm::dvec2 barycentric{0.0};  ///< of the second and third corner
    double area = 0.0;            ///< m^2 that the sample stands for
};

/// Barycentric coordinates (of the second and third corner) of point `index` on a triangle: the first 2^k are
/// spread evenly, and no three of them lie in a line. `seed`: one for each triangle.
glm::dvec2 stratifiedBarycentric(int index, std::uint32_t seed);

/// The values x at `vertices` vertices that minimise  sum_s area_s (interpolated x at s - value_s)^2, for
/// each of `channels` channels: returns vertices * channels numbers. The normal equations are sparse,
/// symmetric and positive definite (three samples in each triangle suffice), and solved by conjugate
/// gradients; `values`: samples * channels. A linear field comes back to 1e-6 of its size; a vertex of no
/// triangle gets 0. Throws Error if the iteration does not converge.
std::vector<double> leastSquaresVertices(std::span<const std::uint32_t> indices, std::size_t vertices,
                                         std::span<const SurfaceSample> samples,
                                         std::span<const double> values, std::size_t channels);

}  // namespace penumbra
