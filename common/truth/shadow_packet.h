// Shadow rays rounded to float for Embree, sixteen side by side, so that whatever blocks the exact segment is
// found by the rounded one; and the bound within which the two can differ.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "common/math/aabb.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

/// Lengths in metres unless told. The origin is lifted off the surface by 16 float ulps of the largest
/// coordinate in play; from there the ray aims at the target, but begins 12 ulps further back (still off the
/// surface, so that the surface itself is not met again and again) and ends further on. Rounding moves an end
/// by at most an ulp along each axis. So lifted, the ray cannot slip under an occluder that stands on the
/// surface, and begun further back it cannot start beyond one, unless it meets it at a grazing angle below
/// 1/24 within a few ulps of where it starts. The price is a silhouette that is moved by at most 16 ulps,
/// 2e-6 of the scene's size, and a surface that is missed where it lies over the origin's own by less than
/// that. Within some ten ulps of a corner Embree itself may find none of the triangles that meet there. Who
/// needs it exacter asks ExactScene, as the truth pictures do.
struct ShadowPacket {
    static constexpr unsigned size = 16;

    alignas(64) float originX[size], originY[size], originZ[size];
    alignas(64) float directionX[size], directionY[size], directionZ[size];
    alignas(64) float far[size];  ///< in units of the direction; negative: a ray of no length, leave it out
    alignas(64) float end[size];  ///< of the exact segment, in units of the direction: 1 or infinity
    /// decisiveUlps, as a length. Larger only costs time: more candidates are tested again in double.
    alignas(64) float tolerance[size];
    alignas(64) std::uint32_t ownTriangle[size];
    /// Bit i: origin i is so near to an edge of its triangle that the lifted ray may start beyond the
    /// neighbour across a fold.
    std::uint32_t nearOwnEdge = 0;
    bool oneOrigin = false;  ///< all rays begin at one point of one triangle
};

/// The scene's reach in all that follows; 0 for an empty box.
double largestCoordinate(const Aabb& bounds);

/// `rays`: 1 to 16; `reach`: largest coordinate of the scene.
void roundToFloat(std::span<const ShadowRay> rays, double reach, ShadowPacket& packet);

/// The smallest height of a triangle, metres, for surelyBlocks; 0, so that double decides, if the triangle is
/// so slender that floats do not know its plane. `reach`: largest coordinate of the scene.
float decisiveHeight(const std::array<glm::dvec3, 3>& triangle, double reach);

/// One float ulp of the largest coordinate in play.
double ulpOf(const ShadowRay& ray, double reach);

/// How far from every border a crossing must be in float, to be one in double too. Derived for these sizes:
/// an ulp is 2^-23 L, L the largest coordinate, so one rounding of a coordinate errs by half an ulp, of a
/// difference of coordinates by one; c is the cosine between ray and normal, b the smallest barycentric, h
/// the smallest height, e the longest edge, and R <= 2 sqrt(3) L the distance of the farthest corner.
///
/// Sideways, the margin b h c that float sees exceeds the exact one by at most 63 ulps:
/// - 16: the lift. (The way back is along the ray, and moves nothing sideways.)
/// - 6.1: the rounded ray. Half an ulp each for the origin, the lift and the way back, one each for the
///   direction and for the lift taken off it: 3.5 along each of three axes.
/// - 1.7: the corners relative to the origin, one along each axis.
/// - 28: Embree's edge function, U = (v2 - v0) x (v2 + v0) . D. Seven roundings of 2^-24 of a sum of products
///   below 2/sqrt(3) |v2 - v0| 2R |D|: as a distance 8.1 * 2^-24 R, 14 ulps; and as much again by the sum
///   U + V + W, of which U is at most a third.
/// - 2.2: the rounding of 1 - u - v, times h < 3 L. So far 54.
/// - 5: a ray a few hundred ulps long is turned by its lift. Both its ends are off the plane by more than the
///   tolerance, so its slant changes by less than 22 %, and the first two lines with it.
/// - 6 % of the sum: c is computed from a normal that is off, see below.
///
/// Off the plane, at the start (at the end there is no lift), by at most 50 ulps and 6 %:
/// - 34.1: the lift, the way back, and the rounded ray; 1.7: the corners.
/// - 5.2: the corner times the normal, three roundings of R.
/// - 9.2: the normal. As a cross product of two edges it errs by an angle of 4.6 * 2^-24 e/h; along the
///   triangle that makes 2.3 ulps e^2/(h L), and decisiveHeight allows e^2/(h L) <= 4.
/// - 6 %: the same angle, and that of the corners, on the way to the start: (2.3 e/L + 3.5) ulps / h, to be
///   compared with c; and the margin sideways has just shown that c > 3 * 64 ulps / h.
///
/// tests/unit/shadow_packet_test.cpp looks for the worst that occurs: 16.5 sideways, and 14 besides the 6 %
/// at the start; 560 where slender triangles are not left to double.
inline constexpr float decisiveUlps = 64.0f;

/// A triangle that Embree found in the way of ray `i`: the smallest of its three barycentrics, the distance
/// `t` in units of the direction, its normal (any length), and its decisiveHeight. Is it there in double
/// too, wherever within their tolerance the exact points are? Then the crossing lies inside the triangle by
/// more than the tolerance, stretched by the slant, and both ends are off its plane by more than it.
inline bool surelyBlocks(const ShadowPacket& packet, unsigned i, float leastBarycentric, float t,
                         const glm::vec3& normal, float height) {
    const float x = packet.directionX[i], y = packet.directionY[i], z = packet.directionZ[i];
    const float descent = std::abs(x * normal.x + y * normal.y + z * normal.z);
    // The sum of magnitudes is at least the length, and needs no root.
    const float tolerance =
        packet.tolerance[i] * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    const float length = std::abs(x) + std::abs(y) + std::abs(z);
    return leastBarycentric * height * descent > tolerance * length && t * descent > tolerance &&
           (packet.end[i] - t) * descent > tolerance;
}

}  // namespace penumbra
