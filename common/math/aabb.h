// Axis-aligned bounding boxes in double precision.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace penumbra {

/// Closed box [lower, upper] in metres. Default-constructed: empty (extending it by a point gives that
/// point).
struct Aabb {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    void extend(const glm::dvec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void extend(const Aabb& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    glm::dvec3 centre() const { return 0.5 * (lower + upper); }
    glm::dvec3 size() const { return upper - lower; }
    /// Radius of the sphere around the centre that holds the box.
    double radius() const { return empty() ? 0.0 : 0.5 * glm::length(size()); }
    /// Corner 0..7; bit 0 selects upper x, bit 1 upper y, bit 2 upper z.
    glm::dvec3 corner(int i) const {
        return {(i & 1) ? upper.x : lower.x, (i & 2) ? upper.y : lower.y, (i & 4) ? upper.z : lower.z};
    }
    /// The corner that is farthest along `n`.
    glm::dvec3 farthestAlong(const glm::dvec3& n) const {
        return corner((n.x > 0.0 ? 1 : 0) | (n.y > 0.0 ? 2 : 0) | (n.z > 0.0 ? 4 : 0));
    }
    /// Of `p` from the nearest point of the box; 0 inside.
    double squaredDistance(const glm::dvec3& p) const {
        const glm::dvec3 gap = p - glm::clamp(p, lower, upper);
        return glm::dot(gap, gap);
    }
};

}  // namespace penumbra
