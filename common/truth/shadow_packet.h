// Shadow rays rounded to float for Embree, sixteen side by side, so that whatever blocks the exact segment is
// found by the rounded one; and the bound within which the two can differ.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "common/truth/ray_tracer.h"

namespace penumbra {

/// Lengths in metres unless told. The origin is lifted off the surface by 16 float ulps of the largest
/// coordinate in play; from there the ray aims at the target, but begins 12 ulps further back (still off the
/// surface, so that the surface itself is not met again and again) and ends further on. Rounding moves an end
/// by at most an ulp along each axis. So lifted, the ray cannot slip under an occluder that stands on the
/// surface, and begun further back it cannot start beyond one, unless it meets it at a grazing angle below
/// 1/24 within a few ulps of where it starts. The price is a silhouette that is moved by at most 16 ulps,
/// 2e-6 of the scene's size. Who needs it exacter asks ExactScene, as the truth pictures do.
struct ShadowPacket {
    static constexpr unsigned size = 16;

    alignas(64) float originX[size], originY[size], originZ[size];
    alignas(64) float directionX[size], directionY[size], directionZ[size];
    alignas(64) float far[size];  ///< in units of the direction; negative: a ray of no length, leave it out
    alignas(64) float end[size];  ///< of the exact segment, in units of the direction: 1 or infinity
    /// 64 ulps: what the exact and the rounded ray can be apart anywhere (16 lifted, 12 back, 8 of rounding
    /// in both ends) plus what Embree's robust test (Pluecker coordinates, floats relative to the origin) can
    /// be off by, 20 ulps, and 8 in reserve. Larger only costs time: more candidates are tested again in
    /// double.
    alignas(64) float tolerance[size];
    alignas(64) std::uint32_t ownTriangle[size];
    /// Bit i: origin i is so near to an edge of its triangle that the lifted ray may start beyond the
    /// neighbour across a fold.
    std::uint32_t nearOwnEdge = 0;
};

/// `rays`: 1 to 16; `reach`: largest coordinate of the scene.
void roundToFloat(std::span<const ShadowRay> rays, double reach, ShadowPacket& packet);

/// One float ulp of the largest coordinate in play.
double ulpOf(const ShadowRay& ray, double reach);

/// A triangle that Embree found in the way of ray `i`: the smallest of its three barycentrics, the distance
/// `t` in units of the direction, its normal (any length), and its smallest height. Is it there in double
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
