// Does a triangle stand strictly between two points? In double, with the rounding bound of the answer.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace penumbra {

/// From `origin` to the point `target`, or on towards infinity along the direction `target`.
struct Segment {
    glm::dvec3 origin;
    glm::dvec3 target;
    bool towardsInfinity = false;

    glm::dvec3 direction() const { return towardsInfinity ? target : target - origin; }
};

enum class Crossing {
    none,    ///< both ends on one side of the plane, or an end in the plane (touching is not crossing)
    missed,  ///< the plane is crossed strictly between the ends, but outside the triangle
    inside,  ///< the triangle is crossed, its border included: of triangles that share an edge none lets a
             ///< ray through
};

/// Ends closer to the plane than the rounding error of this very computation count as in the plane.
Crossing crossTriangle(const Segment& segment, const std::array<glm::dvec3, 3>& triangle);

}  // namespace penumbra
