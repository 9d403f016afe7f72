// The triangles of the axis `shape`, by the handful.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/truth/cone_subtraction.h"
#include "tests/stress/dice.h"

namespace penumbra::stress {

/// Where triangles are wanted.
struct TrianglePlace {
    glm::dvec3 centre{0.0};
    double size = 1.0;                ///< of the triangles, about
    glm::dvec3 plane{0.0, 0.0, 1.0};  ///< normal of what they may be coplanar with
};

/// One to eight triangles of that shape (axes.cpp has the names): needles are 1e-3 to 1e-14 as wide as long;
/// slivers are that flat, with a blunt angle; degenerate ones have no area at all; coplanar ones lie in one
/// plane, some beside another and some over another; coincident ones have the same corners, in any order;
/// interpenetrating ones all go through each other.
std::vector<Triangle> trianglesOf(const std::string& shape, const TrianglePlace& where, Dice& dice);

}  // namespace penumbra::stress
