// Exact ambient visibility and bent vectors of simple situations, in double: what bakers are measured
// against.
//
// Everything is said in the frame of the point: +z is its normal, and +x the tangent that each function
// names. Lengths are in any one unit, since only ratios count; angles in radians.
#pragma once

#include <glm/glm.hpp>

#include "common/truth/direction_moments.h"

namespace penumbra {

/// What a point sees of the sky, in both weightings. With V(w) = 1 where direction w is open:
///     cosine  = 1/pi  int V (n.w) dw     cosineBent  = 1/pi  int V w (n.w) dw
///     uniform = 1/2pi int V dw           uniformBent = 1/2pi int V w dw
/// They differ: in a corner of two planes both visibilities are 1/2, but the bent vectors lean from the
/// normal by atan(2/pi) = 32.48 and by 45 degrees. As it stands: open ground.
struct AmbientForm {
    double cosine = 1.0;
    double uniform = 1.0;
    glm::dvec3 cosineBent{0.0, 0.0, 2.0 / 3.0};
    glm::dvec3 uniformBent{0.0, 0.0, 0.5};
};

/// The sky is seen in the region's directions only, or everywhere but there.
AmbientForm ambientThrough(const DirectionMoments& region);
AmbientForm ambientBesides(const DirectionMoments& blocked);

/// A sphere at `centre`, which may dip below the horizon; the point lies outside of it or touches it. A whole
/// cap takes cos(b) / H^2 off `cosine` and 1 - cos(sigma) off `uniform` (b: angle of the centre from the
/// normal, H: its distance in radii, sigma = asin(1/H)). (Cunningham 1961, NASA TN
/// D-710; Snyder 1996, MSR-TR-96-11.)
AmbientForm ambientUnderSphere(const glm::dvec3& centre, double radius);

/// Anything infinitely long along y: the sky shows for profile angles of `from` to `to`, measured from +x (0)
/// over the normal (pi/2) to -x (pi); 0 <= from <= to <= pi.
AmbientForm ambientInProfile(double from, double to);

/// On the ground, an endless vertical wall of `height` (infinity: two perpendicular planes) at x =
/// `distance`: cosine = (1 + x / sqrt(x^2 + h^2)) / 2.
AmbientForm ambientBesideWall(double distance, double height);

/// On a slope under an open sky that ends at the level horizon; +x points downhill: cosine = (1 + cos
/// tilt)/2. This is the hemisphere term of chapter 09. 0 <= tilt <= pi.
AmbientForm ambientOnSlope(double tilt);

/// Anywhere on a wall of an endless V whose walls are 2 `halfOpening` apart; +x points up the wall:
/// cosine = sin^2(halfOpening).
AmbientForm ambientInVGully(double halfOpening);

/// In an endless ditch of rectangular section: on its floor, `x` from the wall at -x, or on a wall, `below`
/// its rim with +x pointing up: cosine = (1 - y / sqrt(y^2 + w^2)) / 2.
AmbientForm ambientOnGullyFloor(double x, double width, double depth);
AmbientForm ambientOnGullyWall(double below, double width);

/// In an endless trench whose section is an arc of a circle, `rim` radians to each side of the bottom (0 <
/// rim < pi), the point `angle` from the bottom towards +x: cosine = cos(rim/2) cos(angle/2), brightest at
/// the bottom, although the chord of the rims subtends the same angle everywhere (Euclid III.21), so that
/// `uniform` is constant. (Langer & Zucker 1994, JOSA A 11; the normal's part in it: Stewart & Langer 1997,
/// PAMI 19.)
AmbientForm ambientInTrench(double rim, double angle);

/// In a spherical pit whose rim lies `rim` from the bottom as seen from the centre, the point `angle` from
/// the bottom towards +x, angle < rim: cosine = (1 + cos rim)/2, constant over the whole pit (a chord makes
/// equal angles at both ends; as in the integrating sphere of Ulbricht 1900, ETZ 21). The others by
/// quadrature.
AmbientForm ambientInPit(double rim, double angle);

/// Under a disk parallel to the ground, at `height`, its centre over x = `offset`: 1 - cosine is
/// (1 - (h^2 + a^2 - r^2) / sqrt((h^2 + a^2 + r^2)^2 - 4 a^2 r^2)) / 2 (Hamilton & Morgan 1952, NACA TN
/// 2836). The others by quadrature.
AmbientForm ambientUnderDisk(double radius, double height, double offset);

/// Under the rectangle [lower, upper] at `height`, parallel to the ground, the point under the origin of xy.
AmbientForm ambientUnderRectangle(const glm::dvec2& lower, const glm::dvec2& upper, double height);

/// Beside an endless, endlessly high wall at x = `distance`, where only what is nearer than `range` blocks:
/// with cos t = distance / range, cosine = 1 - (t - sin t cos t) / pi; exactly open from `range` on.
AmbientForm ambientBesideWallWithin(double distance, double range);

/// The same wall when what is d away leaves 1 - (1 - d/range)^2 of its direction open (obscurance with a
/// quadratic falloff; Zhukov, Iones & Kronin 1998, EGWR).
AmbientForm ambientBesideFadingWall(double distance, double range);

/// Irradiance under the CIE overcast sky of zenith radiance 1, L = (1 + 2 w.up)/3 (Moon & Spencer 1942,
/// Illum. Eng. 37); 7 pi / 9 on open ground. `up` in the frame of the point; nothing of what `seen` sees may
/// lie below the level horizon.
double overcastIrradiance(const AmbientForm& seen, const glm::dvec3& up);

}  // namespace penumbra
