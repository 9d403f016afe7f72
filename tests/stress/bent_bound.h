// How long can a bent vector be?
#pragma once

#include <algorithm>
#include <cmath>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"

namespace penumbra::stress {

/// The longest bent vector that goes with `visibility`. Of all sets of directions of one measure the cap
/// about the normal has the longest mean: seen along any other axis u, the directions within an angle of u,
/// cut off at the horizon, measure no more than those within the same angle of the normal. Of the cap that
/// measures A: cosine 2/3 (1 - (1-A)^(3/2)), uniform A - A^2/2.
inline double longestBent(double visibility, Weighting weighting) {
    const double dark = std::max(0.0, 1.0 - visibility);
    return weighting == Weighting::cosine ? 2.0 / 3.0 * (1.0 - dark * std::sqrt(dark))
                                          : 0.5 * (1.0 - dark * dark);
}

/// Of `rays` directions spread evenly no cap holds more than this part too many (Beck 1984, Mathematika 31:
/// for the best sets N^(-3/4) up to a logarithm).
inline double discrepancy(int rays) {
    return 2.0 * std::pow(double(rays), -0.75);
}

}  // namespace penumbra::stress
