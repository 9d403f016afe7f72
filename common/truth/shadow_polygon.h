// The exact hard shadow of a triangle from a point light on a plane, and what a shadow map of finite
// resolution must get wrong.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "common/math/polygon.h"
#include "common/truth/cone_subtraction.h"
#include "common/truth/planar_receiver.h"

namespace penumbra {

/// The shadow that `triangle` casts from a point light on `receiver`, in its (u, v), clipped to [0,1]^2; any
/// winding. Empty where it casts none: below the plane, above the light, or the light itself not above the
/// plane. Only the part between plane and light casts: projecting the rest too is the "negative projection"
/// error, a false shadow on the far side. The projection stays homogeneous until it is clipped to the
/// receiver, so a vertex at the light's height, whose shadow is infinitely far away, needs no tuned limit
/// (Blinn & Newell, "Clipping Using Homogeneous Coordinates", SIGGRAPH 1978).
Polygon2 shadowPolygon(const Triangle& triangle, const glm::dvec3& light, const PlanarReceiver& receiver);

/// Share in [0,1] of the cell [lower, upper] that a convex polygon of at most 20 vertices (any winding)
/// covers. Exactly 0 outside it, exactly 1 inside.
double cellCoverage(const Polygon2& polygon, const glm::dvec2& lower, const glm::dvec2& upper);

/// Expected mis-area of a shadow map per unit length of shadow boundary, in texel footprints: the mean of
/// |map - exact coverage| over random sub-texel positions of an edge along `edgeDirection` (texel axes, any
/// length), for nearest sampling at texel centres and exact depths: c/4 + s^2/(12c), with c, s the larger and
/// the smaller of |cos|, |sin|. 0.25 along an axis, 0.2357 at 45 degrees, mean 0.2436. Times the footprint
/// (metres) it is an area per metre. Half a texel of misregistration about doubles it: a measured figure
/// above 1.15 times this is a bug.
double expectedMisArea(const glm::dvec2& edgeDirection);

}  // namespace penumbra
