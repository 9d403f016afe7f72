// What percentage-closer filtering converges to at an ideal shadow edge: the exact answers of the
// fixed-kernel chapters.
#pragma once

#include <glm/glm.hpp>

namespace penumbra {

/// Lit fraction of a disk of radius `radius` whose centre lies `distance` on the lit side of a straight
/// shadow edge (negative: in the shadow; same unit). 0 and 1 beyond the radius. A radius of 0 gives the hard
/// test.
double diskCoverage(double distance, double radius);

/// The same for a square box of width `width`; `edgeNormal` in the box's axes, any length. The edge profile
/// of two 1-D boxes: a linear ramp along an axis, a trapezoid's integral otherwise.
double boxCoverage(double distance, double width, const glm::dvec2& edgeNormal);

/// A (2k+1) x (2k+1) grid, one texel apart, of taps with bilinear comparison (2x2 tests, then interpolated),
/// across an axis-aligned edge of the texels `distance` texels away (positive: lit): one linear ramp, 2k+1
/// texels wide.
double bilinearCompareRamp(double distance, int k);

/// The weight, along one axis, that this grid gives to the test of the texel whose centre is `offset` texels
/// from the look-up: a trapezoid, flat over 2k texels and 2k+2 wide. The weights of all texels sum to 1; in
/// two dimensions multiply.
double bilinearCompareWeight(double offset, int k);

/// Lit fraction of a disk of radius `radius` with a dark disk of radius `blobRadius` at its centre.
double blobCoverage(double blobRadius, double radius);

/// Lit fraction of a disk of radius `radius` with a dark bar of width 2 `halfWidth` through its centre.
double barCoverage(double halfWidth, double radius);

}  // namespace penumbra
