// A comparison of a picture with its exact answer, as a test: recorded when it passes, explained when it
// fails.
#pragma once

#include <limits>
#include <string>

#include "common/image/compare.h"
#include "common/image/image.h"

namespace penumbra {

/// What a comparison has to keep. A bound left out is not checked; at least one has to be given.
/// State where a bound comes from (a derivation, a quantum, a measured figure with its reserve) next to its
/// number.
struct ImageBounds {
    double rmse = std::numeric_limits<double>::infinity();
    double meanAbs = std::numeric_limits<double>::infinity();
    double maxAbs = std::numeric_limits<double>::infinity();
    double absBias = std::numeric_limits<double>::infinity();  ///< |mean of actual - exact|
    /// Largest share of pixels that the mask may leave out: an error figure over a few lucky pixels is worth
    /// nothing.
    double excludedShare = 0.9;
};

/// Compares `actual` with `exact` where `mask` is not 0 (empty: everywhere) and fails the running GoogleTest,
/// with the ten worst pixels in the message, when a bound is broken. Returns the figures, for further
/// expectations.
///
/// `name` is a path unique in the whole run, chapter first: "03_polygon_offset/contact/visibility". Every
/// comparison leaves out/test/NAME/record.json; a failing one also actual, exact and error x10 as .png (and
/// the first two as .exr).
/// `./test` gathers the records in out/test/index.html. $PENUMBRA_TEST_OUTPUT replaces out/test.
/// Sizes or channels that differ, and a mask that leaves nothing, are failures too.
ImageError expectImage(const std::string& name, const FloatImage& actual, const FloatImage& exact,
                       const FloatImage& mask, const ImageBounds& bounds);

}  // namespace penumbra
