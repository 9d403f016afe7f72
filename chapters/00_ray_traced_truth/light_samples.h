// Where shadow rays go: a light as points, each with the irradiance that it stands for.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/scene/light.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

struct LightSample {
    glm::dvec3 target{0.0};   ///< a point of the light; for directional lights the direction towards it
    glm::dvec3 toLight{0.0};  ///< unit
    glm::dvec3 facingIrradiance{0.0};  ///< on a plane that faces the sample, nothing in between, W/m^2
};

/// A point of an area light from the unit square, preserving area: its polygon is chosen by u.x, which is
/// then stretched again.
glm::dvec3 pointOnLight(const Light& light, glm::dvec2 u);

/// Point, spot, directional: the one sample there is. Area: `count` Owen-scrambled points, whose pattern
/// `seed` chooses, scaled so that together they give the irradiance of Lambert's formula exactly (a ratio
/// estimator: Heitz, Hill & McGuire 2018, I3D). So what nothing shadows has no noise, however few samples
/// there are. Empty: no light arrives from this side of the surface.
std::vector<LightSample> sampleLight(const Light& light, const Hit& hit, int count, std::uint32_t seed);

}  // namespace penumbra
