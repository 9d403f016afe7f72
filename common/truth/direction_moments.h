// Integrals over a region of directions: what every closed form of ambient visibility is made of.
//
// The frame is that of the point: its normal is +z, and regions lie above its horizon z = 0. `second` is two
// axes of Arvo's tensor int w w^T dw ("Applications of irradiance tensors to the simulation of non-Lambertian
// phenomena", SIGGRAPH 1995), contracted with the normal. By Stokes' theorem it and `first` are integrals
// over the region's edge, with m the edge's outward normal on the sphere:
//     first = -1/2 int m ds,    second = 1/3 (solidAngle z - int w (m.z) ds).
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace penumbra {

/// Of a region of unit directions w.
struct DirectionMoments {
    double solidAngle = 0.0;  ///< int dw, sr
    glm::dvec3 first{0.0};    ///< int w dw; its z is pi times the form factor (Nusselt 1928)
    glm::dvec3 second{0.0};   ///< int w (w.z) dw; its z is int (w.z)^2 dw
};

/// Everything above the horizon: 2 pi, pi z, (2 pi/3) z.
DirectionMoments hemisphereMoments();

/// A cap of half-angle s about the unit vector `axis`, cut by the horizon; `sine` = sin s, `cosine` = cos s,
/// 0 < s <= pi/2. (Form factor: Cunningham 1961, NASA TN D-710; Howell, "A Catalog of Radiation Configuration
/// Factors", 1982; Snyder, "Area light sources for real-time graphics", 1996, Microsoft Research
/// MSR-TR-96-11.)
DirectionMoments capMoments(const glm::dvec3& axis, double sine, double cosine);

/// Between two planes through the y axis: directions whose projection on xz makes an angle of `from` to `to`
/// with +x; 0 <= from <= to <= pi, pi/2 being the normal.
DirectionMoments wedgeMoments(double from, double to);

/// A convex polygon seen from the origin, all of it at z >= 0, its front (counter-clockwise) facing the
/// origin. (Lambert 1760; Van Oosterom & Strackee 1983, IEEE Trans. Biomed. Eng. 30(2), for the solid angle.)
DirectionMoments polygonMoments(std::span<const glm::dvec3> corners);

/// A disk seen from the origin, all of it at z >= 0: the rim is centre + cos(t) u + sin(t) v, with
/// centre . (u x v) > 0. The edge integrals are sums over evenly spaced points of the rim, as many as it
/// takes: for a periodic analytic integrand the error falls exponentially. It takes about 40 radii / distance
/// of the origin from the rim; a million at most, so down to 4e-5 radii. (Paxton 1959, Rev. Sci. Instrum. 30,
/// has the solid angle in elliptic integrals.)
DirectionMoments diskMoments(const glm::dvec3& centre, const glm::dvec3& u, const glm::dvec3& v);

}  // namespace penumbra
