// What a light sends to a point when nothing is in between, and the two picture-wide levels derived from it.
// The GLSL twin is shaders/common/light.glsl; a test holds the two together.
#pragma once

#include <glm/glm.hpp>

#include "common/scene/scene.h"

namespace penumbra {

/// Unit vector from `x` towards the light (area light: towards its centre).
glm::dvec3 directionToLight(const Light& light, const glm::dvec3& x);

/// Unoccluded irradiance at `x` on a plane that faces the light, linear RGB W/m^2. Point and spot: emission /
/// r^2 times the spot's cone; directional: emission. An area light is taken as a point at its centre of the
/// same radiant intensity, radiance * area * cos(angle to its normal), 0 behind it: right far away, wrong
/// nearby (chapter 08 does it exactly).
glm::dvec3 facingIrradiance(const Light& light, const glm::dvec3& x);

/// Spot attenuation in [0,1]: 1 inside the inner cone, 0 outside the outer one, squared linear ramp of the
/// cosine between (KHR_lights_punctual); 1 for other types. `toLight` unit.
double spotFactor(const Light& light, const glm::dvec3& toLight);

/// The reference level of a picture: mean over RGB of facingIrradiance of light `index` (-1: the sum over all
/// lights) at a typical distance inside the scene. Never 0.
double keyIrradiance(const Scene& scene, int index);

/// Radiance that maps to white: a white diffuse surface in key light. Chapters render radiance; pictures are
/// scaled by this.
float exposure(const Scene& scene, int index);

/// Radiance of a surface of reflectance 1 under the constant ambient term: `fraction` of what key light gives
/// it.
glm::vec3 ambientRadiance(const Scene& scene, int index, double fraction);

}  // namespace penumbra
