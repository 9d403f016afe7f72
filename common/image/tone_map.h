// From linear radiance to something a screen can show, and from a scalar to a colour.
#pragma once

#include "common/image/image.h"

namespace penumbra {

/// Scales by `exposure` and compresses highlights with a curve that is linear below 0.8 of white and never
/// clips hue to white abruptly; result in [0,1], linear. 3 channels in, 3 out; 1 channel is only scaled and
/// clamped.
FloatImage toneMap(const FloatImage& image, float exposure);

/// Maps a 1-channel image from [low, high] to a perceptually uniform colour map (dark blue to yellow,
/// monotone in luminance, so it survives grey-scale printing). NaN becomes magenta: it must be seen.
FloatImage falseColour(const FloatImage& image, float low, float high);

}  // namespace penumbra
