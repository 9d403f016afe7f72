// The 1-norm: what rounding errors of sums and products are proportional to.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace penumbra {

inline double sumOfMagnitudes(const glm::dvec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

}  // namespace penumbra
