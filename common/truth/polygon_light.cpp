#include "common/truth/polygon_light.h"

namespace penumbra {

double formFactor(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon) {
    return sumOverPyramids(x, n, polygon, [](const LightPyramid& p) { return formFactorOf(p, p.light); });
}

double visibleFormFactor(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                         std::span<const Triangle> occluders) {
    return sumOverPyramids(x, n, polygon,
                           [&](const LightPyramid& p) { return visibleFormFactor(p, occluders); });
}

}  // namespace penumbra
