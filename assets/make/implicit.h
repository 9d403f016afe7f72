// Smooth bodies from signed distances, blended into one another, and the surface through them.
#pragma once

#include <functional>

#include "assets/make/mesh.h"

namespace penumbra::assets {

using DistanceField = std::function<double(const Vec3&)>;  ///< metres, negative inside

/// Distance to the capsule from a (radius ra) to b (radius rb); exact if both radii are equal.
double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb);
/// Roughly the distance to an axis-aligned ellipsoid (right on its surface).
double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii);
/// Union that melts the two together over about `blend` metres (Quilez's polynomial smooth minimum, 2013).
double melt(double a, double b, double blend);

/// Closed surface of field = 0 inside the box, on a grid of `cell` metres: naive surface nets (Gibson 1998),
/// then each vertex moved onto the surface along the gradient. The box must hold the whole surface.
Mesh surfaceOf(const DistanceField& field, const Vec3& lower, const Vec3& upper, double cell);

}  // namespace penumbra::assets
