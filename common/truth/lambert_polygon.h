// Lambert's formula for a polygon that is already relative to the receiver and above its horizon.
#pragma once

#include "common/math/polygon.h"

namespace penumbra {

/// Form factor of `polygon` (relative to the receiver, above its horizon, clockwise about `n`: the front
/// faces the receiver). Lambert 1760; Baum, Rushmeier & Winget, SIGGRAPH 1989. Never negative.
double lambertFormFactor(const glm::dvec3& n, const Polygon3& polygon);

}  // namespace penumbra
