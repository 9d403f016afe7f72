// Closed forms for polygonal area lights, in double (design: "the exact answers").
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "common/truth/cone_subtraction.h"

namespace penumbra {

/// Lambert's formula (Lambert 1760; Baum, Rushmeier & Winget, SIGGRAPH 1989): form factor F = E / (pi L) of a
/// one-sided convex planar polygon seen from `x` with unit normal `n`; E irradiance, L the polygon's
/// radiance. `polygon` counter-clockwise seen from its front, cut at the receiver's horizon here; from
/// behind, or in its plane (the formula jumps there): 0. Relative error below 1e-14 at any distance, as long
/// as the horizon does not cut most of the polygon off; where all its light grazes x, two ulps over the
/// cosine more.
double formFactor(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon);

/// The same with opaque triangles in between, by subtracting each triangle's cone from the light in direction
/// space: exact for any number and overlap of occluders; an umbra behind a single triangle is exactly 0.
/// Triangles that x lies in the plane of, that are behind the light or in its plane, or have no area, change
/// nothing, to the bit. Never negative, never above formFactor; a surface cut into more triangles gives the
/// same to 1e-14, however near `x` is to the light. Allocates nothing once warm; threads may call
/// it side by side.
double visibleFormFactor(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                         std::span<const Triangle> occluders);

}  // namespace penumbra
