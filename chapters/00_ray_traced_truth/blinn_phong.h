// Blinn-Phong on the CPU: the same formulas as shaders/common/blinn_phong.glsl and material.glsl.
#pragma once

#include <glm/glm.hpp>

#include "common/scene/scene.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

/// What a surface point reflects and emits.
struct Surface {
    glm::dvec3 normal{0.0};    ///< unit, by interpolation, on the side one looks at
    glm::dvec3 diffuse{0.0};   ///< linear reflectance, texture included
    glm::dvec3 specular{0.0};  ///< linear reflectance at normal incidence
    double shininess = 1.0;
    glm::dvec3 emission{0.0};  ///< radiance towards the eye, W/(m^2 sr)
};
Surface surfaceAt(const Scene& scene, const Hit& hit);

/// Reflected radiance for each unit of facing irradiance (Blinn, "Models of Light Reflection for Computer
/// Synthesized Pictures", SIGGRAPH 1977; normalised by Hoffman's fit, SIGGRAPH course notes 2010). `toLight`,
/// `toEye` unit.
glm::dvec3 blinnPhong(const Surface& surface, const glm::dvec3& toLight, const glm::dvec3& toEye);

}  // namespace penumbra
