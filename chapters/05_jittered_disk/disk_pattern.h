// Where to test: patterns of sample points on a disk. Pure functions; chapters 06 and 07 reuse them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

/// How points are spread over the unit square. All but `random` are stratified: N equal areas hold one point
/// each.
enum class SquarePattern {
    random,     ///< white noise: clumps and gaps
    regular,    ///< the same place in every cell of a grid
    jittered,   ///< a random place in every cell of a grid (Cook 1986, ACM Trans. Graphics 5(1))
    fibonacci,  ///< a lattice along the golden section, shifted at random
    sobol       ///< Sobol's sequence, Owen-scrambled
};

/// How the square is bent into the disk.
enum class DiskMap {
    concentric,  ///< squares to circles, cells stay compact (Shirley & Chiu 1997, J. Graphics Tools 2(3))
    polar,       ///< angle and the square root of a radius: area stays area
    polarLinear  ///< without the square root: half of the points in the inner quarter. Wrong, for the page
};

/// "random", "regular", "jittered", "fibonacci", "sobol"; "concentric", "polar", "polar-linear": in the order
/// of the constants.
const std::vector<std::string>& squarePatternNames();
const std::vector<std::string>& diskMapNames();
/// From one of those names. Throws UsageError.
SquarePattern squarePattern(const std::string& name);
DiskMap diskMap(const std::string& name);

/// `count` points of [0,1)^2. The same seed gives the same points; for random seeds every point's
/// neighbourhood is equally likely, so that means over the points are unbiased.
std::vector<glm::dvec2> squarePoints(SquarePattern pattern, int count, std::uint32_t seed);

/// `u` of the unit square on the unit disk.
glm::dvec2 onDisk(DiskMap map, const glm::dvec2& u);

/// Both: `count` points of the unit disk.
std::vector<glm::dvec2> diskPattern(SquarePattern pattern, DiskMap map, int count, std::uint32_t seed);

/// Share of `points` on the lit side (n . p < distance) of a straight edge with unit normal `n`: what a
/// filter with this pattern answers; diskCoverage(distance, 1) is exact.
double litShare(std::span<const glm::dvec2> points, const glm::dvec2& n, double distance);

}  // namespace penumbra
