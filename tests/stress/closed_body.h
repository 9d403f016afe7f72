// Closed convex bodies, as round or as flat as may be, where a case wants them.
#pragma once

#include "common/scene/scene.h"
#include "tests/stress/case.h"
#include "tests/stress/dice.h"

namespace penumbra::stress {

/// A tetrahedron, a box, or a ball of 20 to 320 triangles, stretched along its axes by factors from
/// `flattest` to 1, turned, of radius `scale` and moved along a diagonal; then rounded to float. Vertices are
/// shared; normals are means of the faces', of the body before it is rounded. Axes: scale, distance.
Scene closedBody(const Case& given, double flattest, Dice& dice);

/// One float ulp of the scene's largest coordinate, metres.
double floatUlp(const Scene& scene);

}  // namespace penumbra::stress
