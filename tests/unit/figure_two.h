// Heckbert & Herf, "Simulating Soft Shadows with Graphics Hardware" (CMU-CS-97-104, 1997), figure 2, with z
// up: a square light over a triangle over the plane z = 0.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "common/truth/cone_subtraction.h"

namespace penumbra::figure_two {

inline const std::vector<glm::dvec3> light = {{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}};
inline const Triangle triangle = {glm::dvec3(-0.4, -0.35, 1), glm::dvec3(0.45, -0.3, 1),
                                  glm::dvec3(0, 0.45, 1)};

/// Form factors of the light at `x`, without and with the triangle; 15 decimals.
struct Golden {
    glm::dvec3 x;
    double whole, visible;
};
inline const std::array<Golden, 5> golden = {{{{0, 0, 0}, 0.073477634812521, 0.010136018748940},
                                              {{0.5, 0, 0}, 0.066182613783407, 0.033582065875840},
                                              {{-0.3, 0.4, 0}, 0.066185270360017, 0.041509825007278},
                                              {{0.9, 0.9, 0}, 0.039936405170093, 0.039936405170093},
                                              {{0, -0.8, 0}, 0.056677133901376, 0.040911767947412}}};

}  // namespace penumbra::figure_two
