// A cut through the picture: how ambient visibility goes up and down along a row of it.
#pragma once

#include <vector>

#include "chapters/09_ambient_occlusion/pixel_rays.h"

namespace penumbra {

/// RGBA, rows up, frame.size pixels. The upper three quarters: ambient visibility of the middle row's pixels,
/// 0 at the foot and 1 near the top (lines at every fourth); the lowest quarter: the surface itself, its
/// height over the row.
std::vector<float> profilePicture(const Frame& frame, const PixelRays& pixels);

}  // namespace penumbra
