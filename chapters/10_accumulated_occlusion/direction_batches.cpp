#include "chapters/10_accumulated_occlusion/direction_batches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>

namespace penumbra {

namespace {

/// What rounding a normal or a direction to float may change of a dot product, with a wide margin.
constexpr double rounding = 1e-5;

bool before(const glm::dvec3& a, const glm::dvec3& b, int axis) {
    return std::tie(a[axis], a.x, a.y, a.z) < std::tie(b[axis], b.x, b.y, b.z);
}

void halve(std::span<glm::dvec3> directions, std::size_t leaf) {
    if (directions.size() <= leaf) return;
    glm::dvec3 lower(2.0), upper(-2.0);
    for (const glm::dvec3& l : directions) {
        lower = glm::min(lower, l);
        upper = glm::max(upper, l);
    }
    const glm::dvec3 size = upper - lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // Whole leaves on the left, so that batches begin where a half begins.
    const std::size_t leaves = (directions.size() + leaf - 1) / leaf;
    const std::size_t middle = leaves / 2 * leaf;
    std::nth_element(directions.begin(), directions.begin() + std::ptrdiff_t(middle), directions.end(),
                     [axis](const glm::dvec3& a, const glm::dvec3& b) { return before(a, b, axis); });
    halve(directions.first(middle), leaf);
    halve(directions.subspan(middle), leaf);
}

}  // namespace

std::vector<glm::dvec3> compactOrder(std::vector<glm::dvec3> directions, std::size_t leaf) {
    halve(directions, leaf);
    return directions;
}

// [begin:cone]
DirectionCone coneAround(std::span<const glm::dvec3> directions) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& l : directions) sum += l;
    if (glm::length(sum) < 1e-6) return {};
    DirectionCone cone{glm::normalize(sum)};
    double nearest = 1.0;
    for (const glm::dvec3& l : directions) nearest = std::min(nearest, glm::dot(l, cone.axis));
    // Below the horizon of n: all l are acos(horizonCosine) or more away from n, so the axis is farther by
    // the cone's half angle.
    const double angle = std::acos(horizonCosine) + std::acos(std::clamp(nearest, -1.0, 1.0));
    if (angle < 3.14159) cone.below = std::cos(angle) - rounding;
    return cone;
}
// [end:cone]

ReceiverHorizons::ReceiverHorizons(std::span<const glm::vec4> normals) {
    constexpr std::size_t cells = 16;  // along each axis, over [-1, 1]
    std::vector<Box> grid(cells * cells * cells);
    for (const glm::vec4& normal : normals) {
        const glm::vec3 n(normal);
        if (n == glm::vec3(0.0f)) continue;
        const glm::ivec3 at = glm::clamp(glm::ivec3((n * 0.5f + 0.5f) * float(cells)), glm::ivec3(0),
                                         glm::ivec3(int(cells) - 1));
        const std::size_t layer = std::size_t(at.z) * cells * cells, row = std::size_t(at.y) * cells;
        Box& box = grid[layer + row + std::size_t(at.x)];
        box.lower = glm::min(box.lower, n);
        box.upper = glm::max(box.upper, n);
    }
    std::copy_if(grid.begin(), grid.end(), std::back_inserter(boxes_),
                 [](const Box& box) { return box.lower.x <= box.upper.x; });
}

bool ReceiverHorizons::above(const glm::dvec3& toSky) const {
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
        // The corner of the box that looks most towards it.
        const glm::dvec3 n(toSky.x > 0.0 ? box.upper.x : box.lower.x,
                           toSky.y > 0.0 ? box.upper.y : box.lower.y,
                           toSky.z > 0.0 ? box.upper.z : box.lower.z);
        return glm::dot(n, toSky) > horizonCosine - rounding;
    });
}

}  // namespace penumbra
