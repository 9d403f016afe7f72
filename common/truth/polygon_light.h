// Closed forms for polygonal area lights, in double (design: "the exact answers").
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

namespace penumbra {

using Triangle = std::array<glm::dvec3, 3>;

/// Lambert's formula (Lambert 1760; Baum, Rushmeier & Winget 1989): form factor F = E / (pi L) of a one-sided convex
/// planar polygon seen from `x` with unit normal `n`. `polygon` counter-clockwise seen from its front; behind it: 0.
double formFactor(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon);

/// The same with opaque triangles in between, by subtracting each triangle's cone from the light in direction space:
/// exact for any number and overlap of occluders; an umbra behind a single triangle is exactly 0.
double visibleFormFactor(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                         std::span<const Triangle> occluders);

}  // namespace penumbra
