// Sample patterns: low-discrepancy points in the unit square, made anew for every pixel from a hash, and
// their maps onto polygons and disks. Everything is a pure function of its arguments, so a picture never
// depends on the thread count.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace penumbra {

/// A well-mixed 32-bit hash of up to three numbers, e.g. (pixel x, pixel y, seed): the seed of a pixel's own
/// pattern.
std::uint32_t hashSeed(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0);

/// The same as a number in [0, 1).
inline double hashUnit(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0) {
    return hashSeed(a, b, c) * 0x1p-32;
}

/// Point `index` of the 2-D Sobol sequence with nested uniform (Owen) scrambling and shuffling by `seed`, in
/// [0,1)^2. Each prefix of 2^k points is a (0,k,2)-net: every elementary interval of area 2^-k holds one
/// point. (Owen 1998, J. Complexity; hash-based form: Burley, "Practical Hash-based Owen Scrambling", 2020,
/// JCGT 9(4).)
glm::dvec2 owenSobol(std::uint32_t index, std::uint32_t seed);

/// The triangle `abc` from the unit square, preserving area (Heitz, "A Low-Distortion Map Between Triangle
/// and Square", 2019).
glm::dvec3 pointInTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           const glm::dvec2& u);

/// A convex polygon from the unit square, preserving area: a triangle is chosen by u.x, which is then
/// stretched again. A parallelogram is mapped directly, so that a square light keeps the full stratification
/// of its samples.
glm::dvec3 pointInPolygon(std::span<const glm::dvec3> polygon, const glm::dvec2& u);

/// Area of a planar convex polygon, m^2.
double polygonArea(std::span<const glm::dvec3> polygon);

/// The unit disk from the unit square, preserving area and keeping strata compact (Shirley & Chiu, "A Low
/// Distortion Map Between Disk and Square", 1997, Journal of Graphics Tools 2(3)).
glm::dvec2 concentricDisk(const glm::dvec2& u);

}  // namespace penumbra
