// Comparing a picture with its exact answer.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/image/image.h"

namespace penumbra {

struct WorstPixel {
    int x = 0;
    int y = 0;
    float actual = 0.0f;  ///< of the channel that differs most
    float exact = 0.0f;
};

/// Figures over the pixels whose mask is not 0, over all channels. A NaN or infinity in `actual` counts as an
/// error of 1e30: it can never pass a bound.
struct ImageError {
    std::size_t pixels = 0;    ///< counted
    std::size_t excluded = 0;  ///< left out by the mask
    double rmse = 0.0;
    double meanAbs = 0.0;
    double maxAbs = 0.0;
    double bias = 0.0;              ///< mean of actual - exact
    std::vector<WorstPixel> worst;  ///< up to ten, worst first
};

/// `mask`: 1 channel, or empty (0 x 0) for all pixels. Throws Error if sizes or channels differ, or nothing
/// is left to compare (an error figure over no pixels would always pass).
ImageError compareImages(const FloatImage& actual, const FloatImage& exact, const FloatImage& mask = {});

/// |actual - exact| * gain, masked pixels dark blue: what a failing test shows.
FloatImage errorImage(const FloatImage& actual, const FloatImage& exact, const FloatImage& mask,
                      float gain = 10.0f);

}  // namespace penumbra
