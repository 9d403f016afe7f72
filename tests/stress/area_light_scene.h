// A receiver, an area light and what may stand between them, for the closed forms: drawn from a case, and
// moved to where the case wants it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "common/truth/cone_subtraction.h"
#include "tests/stress/case.h"
#include "tests/stress/dice.h"

namespace penumbra::stress {

struct AreaLightScene {
    glm::dvec3 x{0.0};  ///< the receiver ...
    glm::dvec3 normal{0.0, 0.0, 1.0};
    std::vector<glm::dvec3> light;  ///< convex, counter-clockwise seen from its front, which x is on
    std::vector<Triangle> occluders;
};

/// The receiver at the origin, the light's centre at distance 1 and at the case's angle from the normal; the
/// light is up to 64 corners, as flat as may be, and tilted. Axes: shape, light-angle, light-size, variant.
AreaLightScene areaLightScene(const Case& given);

/// Turned by the columns of `turn`, scaled, and then moved; each step rounded.
AreaLightScene moved(const AreaLightScene& scene, const glm::dmat3& turn, double scale, const glm::dvec3& by);

/// The 1-norm of the farthest corner.
double largestMagnitude(const AreaLightScene& scene);

/// An upper bound for what the visible form factor can change by when each point, the receiver too, moves by
/// up to `error`, metres. A border that is seen under the angle a, its nearest point d away, sweeps at most
/// 2 a error / d of the directions, and each of them counts for 1/pi at most. Infinite where that says
/// nothing: a border comes nearer than 8 errors.
double sweptBy(const AreaLightScene& scene, double error);

/// Rounding may decide about something large, and neither answer is wrong: x touches the light or an occluder
/// within `error` metres, or an occluder touches the light's plane or goes through it.
bool onTheEdge(const AreaLightScene& scene, double error);

/// Each occluder as three that meet at a point inside of it.
std::vector<Triangle> cutInThree(const std::vector<Triangle>& occluders, Dice& dice);

}  // namespace penumbra::stress
