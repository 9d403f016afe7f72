// An area light as many points.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra {

/// How the points are spread. Errors against N, in a penumbra: regular N^-1/2 (N^-0.62 when the light's edges
/// do not align with the shadow's) and bands, the others N^-3/4, the best any pattern can do at edges of
/// arbitrary direction (Alexander 1990, "Geometric methods in the study of irregularities of distribution").
enum class LightPattern {
    regular,    ///< cell centres of a grid (Heckbert & Herf 1997)
    jittered,   ///< one random point in every cell (Cook, "Stochastic Sampling in Computer Graphics", 1986)
    fibonacci,  ///< the golden-ratio lattice, shifted at random
    owenSobol,  ///< Sobol's sequence, Owen-scrambled: prefixes of it are good too
};

struct LightPoint {
    glm::dvec3 position{0.0};  ///< on the light; `atInfinity`: the unit direction towards it instead
    double weight = 1.0;       ///< area of the light that it stands for, m^2; 1 for lights without one
    bool atInfinity = false;   ///< a directional light
};

/// `count` points (1 to 4096, checked) on an area light, all of the same weight; `seed` chooses the random
/// part of the pattern. Point, spot and directional lights are one point, whatever `count` is. A grid of a
/// count that is no square has rows of slightly different numbers and heights, so that cells are equal in
/// area.
std::vector<LightPoint> lightPoints(const Light& light, int count, LightPattern pattern, std::uint32_t seed);

}  // namespace penumbra
