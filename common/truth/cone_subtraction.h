// Cone subtraction: which part of a polygonal light is seen past opaque triangles, in direction space.
//
// The light is cut by the cone from x over each triangle; what lies in no cone is seen. Cones have no depth
// to divide by, so a triangle that crosses the plane through x parallel to the light needs no special case
// (projecting the triangle on the light's plane would divide by a depth that changes sign there: "negative
// projection").
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "common/truth/light_pyramid.h"

namespace penumbra {

using Triangle = std::array<glm::dvec3, 3>;

/// What is left of the form factor of the pyramid's light behind `occluders` (world positions). Sums positive
/// terms only, so a deep umbra has no cancellation error, and one triangle over the whole light gives exactly
/// 0.
double visibleFormFactor(const LightPyramid& pyramid, std::span<const Triangle> occluders);

}  // namespace penumbra
