// Lambert's formula for a whole texture of light, in floats and in little time.
#pragma once

#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "common/scene/scene.h"

namespace penumbra {

/// unoccludedIrradiance (exact_receiver.h) as floats, about six times as fast: on a plane the formula is
/// smooth, so tiles of 16x16 texels are worked out at 6x6 of them and interpolated by polynomials of degree 5
/// in u and v. Where that is off by more than 2e-8 at four texels in the worst places, where the light's
/// plane cuts through, and for lights without an area, every texel is worked out. Relative error below 1e-7,
/// most of it the rounding to float.
std::vector<float> unoccludedTexture(const Receiver& receiver, const Light& light);

}  // namespace penumbra
