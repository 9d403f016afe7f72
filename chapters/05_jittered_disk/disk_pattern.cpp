#include "chapters/05_jittered_disk/disk_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.h"
#include "common/math/sampling.h"

namespace penumbra {

namespace {

/// Two random numbers in [0,1) for the point `index`.
glm::dvec2 randomPair(std::uint32_t index, std::uint32_t seed) {
    return glm::dvec2(hashSeed(index, 1, seed), hashSeed(index, 2, seed)) * 0x1p-32;
}

struct Cell {
    glm::dvec2 lower, size;
};

// [begin:cells]
/// `count` cells of equal area, nearly square: rows of nearly equal length, each as high as its cells are
/// many. For a square number, a square grid.
std::vector<Cell> cellsOfSquare(int count) {
    const int rows = int(std::lround(std::sqrt(double(count))));
    std::vector<Cell> cells;
    for (int row = 0; row < rows; ++row) {
        const int first = count * row / rows, last = count * (row + 1) / rows;
        const double width = 1.0 / (last - first);
        for (int i = first; i < last; ++i)
            cells.push_back(
                {{(i - first) * width, double(first) / count}, {width, double(last - first) / count}});
    }
    return cells;
}
// [end:cells]

template <class Value>
Value named(const std::vector<std::string>& names, const std::string& name, const char* flag) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw UsageError("--" + std::string(flag) + " " + name + ": there is no such choice");
    return Value(found - names.begin());
}

/// Each point in its own row of the square, a golden section further along than the last. One shift for all:
/// along the rows, and within them.
glm::dvec2 fibonacciPoint(int index, int count, const glm::dvec2& shift) {
    const double turns = index * (std::numbers::phi - 1.0) + shift.x;
    return {turns - std::floor(turns), (index + shift.y) / count};
}

}  // namespace

const std::vector<std::string>& squarePatternNames() {
    static const std::vector<std::string> names{"random", "regular", "jittered", "fibonacci", "sobol"};
    return names;
}

const std::vector<std::string>& diskMapNames() {
    static const std::vector<std::string> names{"concentric", "polar", "polar-linear"};
    return names;
}

SquarePattern squarePattern(const std::string& name) {
    return named<SquarePattern>(squarePatternNames(), name, "pattern");
}

DiskMap diskMap(const std::string& name) {
    return named<DiskMap>(diskMapNames(), name, "disk-map");
}

// [begin:patterns]
std::vector<glm::dvec2> squarePoints(SquarePattern pattern, int count, std::uint32_t seed) {
    const std::vector<Cell> cells = cellsOfSquare(count);
    const glm::dvec2 shift = randomPair(0, ~seed);
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
        const auto index = std::uint32_t(i);
        const Cell& cell = cells[std::size_t(i)];
        switch (pattern) {
            case SquarePattern::random:
                points.push_back(randomPair(index, seed));
                break;
            case SquarePattern::regular:
                points.push_back(cell.lower + cell.size * shift);
                break;
            case SquarePattern::jittered:
                points.push_back(cell.lower + cell.size * randomPair(index, seed));
                break;
            case SquarePattern::fibonacci:
                points.push_back(fibonacciPoint(i, count, shift));
                break;
            case SquarePattern::sobol:
                points.push_back(owenSobol(index, hashSeed(seed)));
                break;
        }
    }
    return points;
}
// [end:patterns]

// [begin:disk-maps]
glm::dvec2 onDisk(DiskMap map, const glm::dvec2& u) {
    if (map == DiskMap::concentric) return concentricDisk(u);
    // A ring of radius r is 2 pi r long, so radii must come more often in proportion to r: that is what the
    // root does.
    const double radius = map == DiskMap::polar ? std::sqrt(u.y) : u.y;
    const double angle = 2.0 * std::numbers::pi * u.x;
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}
// [end:disk-maps]

std::vector<glm::dvec2> diskPattern(SquarePattern pattern, DiskMap map, int count, std::uint32_t seed) {
    std::vector<glm::dvec2> points = squarePoints(pattern, count, seed);
    for (glm::dvec2& p : points) p = onDisk(map, p);
    return points;
}

double litShare(std::span<const glm::dvec2> points, const glm::dvec2& n, double distance) {
    const auto lit = [&](const glm::dvec2& p) { return glm::dot(n, p) < distance; };
    return double(std::count_if(points.begin(), points.end(), lit)) / double(points.size());
}

}  // namespace penumbra
