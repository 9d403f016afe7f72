// From "this ray meets that triangle" to everything a shader wants to know, in double.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

std::array<glm::dvec3, 3> cornersOf(const Scene& scene, std::uint32_t triangle);

/// Barycentric coordinates (of the second and third corner) where the line meets the triangle. Embree found
/// the hit with a ray rounded to float, so the exact ray may pass by a hair, or see the triangle edge-on:
/// then of the point of its border that is nearest to the line.
glm::dvec2 exactBarycentrics(const Ray& ray, const std::array<glm::dvec3, 3>& triangle);

/// The point of `triangle` at `barycentric`.
Hit surfaceHit(const Scene& scene, std::uint32_t triangle, const glm::dvec2& barycentric);

}  // namespace penumbra
