// Directions: over the hemisphere about a normal, by cosine or by solid angle, and over the whole sphere.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra {

/// Right-handed orthonormal frame, columns (tangent, bitangent, n), for a unit `n`; continuous but for one
/// jump at n.z = 0 (Duff et al., "Building an Orthonormal Basis, Revisited", 2017, JCGT 6(1)).
glm::dmat3 frameAround(const glm::dvec3& n);

/// Direction about +z from the unit square, density cos/pi (Malley: a point of the disk, lifted).
glm::dvec3 cosineDirection(const glm::dvec2& u);

/// Direction about +z from the unit square, density 1/(2 pi); z = 1 - u.x.
glm::dvec3 uniformDirection(const glm::dvec2& u);

/// Direction `index` of `count` on the whole sphere, equal areas (spherical Fibonacci lattice; Hannay & Nye
/// 2004, J. Phys. A 37; weight of each 4 pi / count).
glm::dvec3 fibonacciSphere(int index, int count);

/// `count` directions on the whole sphere from Owen-scrambled Sobol points; weight of each 4 pi / count.
std::vector<glm::dvec3> owenSobolSphere(int count, std::uint32_t seed);

}  // namespace penumbra
