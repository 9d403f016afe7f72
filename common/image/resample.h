// Making pictures smaller.
#pragma once

#include "common/image/image.h"

namespace penumbra {

/// Means of factor x factor pixels, in double. Width and height must be multiples of `factor`; throws Error.
FloatImage boxFilter(const FloatImage& image, int factor);

}  // namespace penumbra
