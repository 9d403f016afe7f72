#include "common/truth/shadow_packet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

constexpr unsigned lanes = ShadowPacket::size;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// What is rounded to float first; all else is float arithmetic, four or more rays at a time.
struct Rounded {
    alignas(64) float normalX[lanes], normalY[lanes], normalZ[lanes];
    alignas(64) float side[lanes];  ///< 1: the ray is on the normal's side; -1: on the other
    alignas(
        64) float aims[lanes];  ///< 1: the target is a point, and the lifted ray aims at it; 0: a direction
    alignas(64) float edgeDistance[lanes];
};

void roundStart(const ShadowRay& ray, unsigned i, ShadowPacket& packet, Rounded& rounded) {
    packet.originX[i] = float(ray.origin.x);
    packet.originY[i] = float(ray.origin.y);
    packet.originZ[i] = float(ray.origin.z);
    packet.ownTriangle[i] = ray.triangle;
    rounded.normalX[i] = float(ray.normal.x);
    rounded.normalY[i] = float(ray.normal.y);
    rounded.normalZ[i] = float(ray.normal.z);
    rounded.edgeDistance[i] = ray.triangle == ShadowRay::noTriangle ? infinity : float(ray.edgeDistance);
}

/// Differences and the side of the surface are decided in double: on the wrong side the ray would slip under
/// whatever stands on the surface.
void roundEnd(const ShadowRay& ray, unsigned i, ShadowPacket& packet, Rounded& rounded) {
    const glm::dvec3 d = ray.towardsInfinity ? ray.target : ray.target - ray.origin;
    rounded.side[i] = glm::dot(d, ray.normal) < 0.0 ? -1.0f : 1.0f;
    packet.directionX[i] = float(d.x), packet.directionY[i] = float(d.y), packet.directionZ[i] = float(d.z);
    packet.end[i] = ray.towardsInfinity ? infinity : 1.0f;
    rounded.aims[i] = ray.towardsInfinity ? 0.0f : 1.0f;
}

/// Not 0 if they differ; without a branch.
std::uint64_t difference(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) ^ std::bit_cast<std::uint64_t>(b);
}

/// The rays from one point to the points of an area light: what belongs to the start is rounded once.
bool startTogether(std::span<const ShadowRay> rays) {
    const ShadowRay& first = rays.front();
    std::uint64_t different = first.triangle == ShadowRay::noTriangle ? 1 : 0;
    for (const ShadowRay& ray : rays.subspan(1))
        different |= difference(ray.origin.x, first.origin.x) | difference(ray.origin.y, first.origin.y) |
                     difference(ray.origin.z, first.origin.z) | (ray.triangle ^ first.triangle);
    return different == 0;
}

/// All rays the start of the first; plain loops, which the compiler turns into a few wide stores.
void spreadStart(ShadowPacket& p, Rounded& r) {
    for (float* lane : {p.originX, p.originY, p.originZ, r.normalX, r.normalY, r.normalZ, r.edgeDistance})
        std::fill_n(lane + 1, lanes - 1, lane[0]);
    std::fill_n(p.ownTriangle + 1, lanes - 1, p.ownTriangle[0]);
}

/// By value: a choice between references is a branch.
float larger(float a, float b) {
    return a > b ? a : b;
}

/// Moves the origins; the loop is free of branches and calls, so that the compiler does several rays at once.
void liftAndPullBack(float reach, ShadowPacket& p, const Rounded& rounded) {
    for (unsigned i = 0; i < lanes; ++i) {
        const float x0 = std::abs(p.originX[i]), y0 = std::abs(p.originY[i]), z0 = std::abs(p.originZ[i]);
        const float largest = larger(larger(reach, x0), larger(y0, z0));
        const float ulp = 0x1p-23f * largest, lift = 16.0f * ulp * rounded.side[i];
        const float liftX = lift * rounded.normalX[i], liftY = lift * rounded.normalY[i],
                    liftZ = lift * rounded.normalZ[i];
        const float x = p.directionX[i] - rounded.aims[i] * liftX;
        const float y = p.directionY[i] - rounded.aims[i] * liftY;
        const float z = p.directionZ[i] - rounded.aims[i] * liftZ;
        const float length = std::sqrt(x * x + y * y + z * z);
        const float back = 12.0f * ulp / length;  // in units of the direction's length
        p.originX[i] += liftX - back * x;
        p.originY[i] += liftY - back * y;
        p.originZ[i] += liftZ - back * z;
        p.directionX[i] = x, p.directionY[i] = y, p.directionZ[i] = z;
        p.tolerance[i] = decisiveUlps * ulp;
        const float far = p.end[i] + 4.0f * back;
        p.far[i] = length > 0.0f ? far : -1.0f;
    }
}

}  // namespace

double largestCoordinate(const Aabb& bounds) {
    if (bounds.empty()) return 0.0;
    const glm::dvec3 size = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    return std::max({size.x, size.y, size.z});
}

void roundToFloat(std::span<const ShadowRay> rays, double reach, ShadowPacket& packet) {
    Rounded rounded;
    packet.oneOrigin = startTogether(rays);
    if (packet.oneOrigin) {
        roundStart(rays.front(), 0, packet, rounded);
        spreadStart(packet, rounded);
    }
    for (unsigned i = 0; i < lanes; ++i) {
        const ShadowRay& ray = rays[i < rays.size() ? i : 0];
        if (!packet.oneOrigin) roundStart(ray, i, packet, rounded);
        roundEnd(ray, i, packet, rounded);
    }
    liftAndPullBack(float(reach), packet, rounded);
    packet.nearOwnEdge = 0;
    for (unsigned i = 0; i < rays.size(); ++i)
        packet.nearOwnEdge |= std::uint32_t(rounded.edgeDistance[i] <= packet.tolerance[i]) << i;
}

float decisiveHeight(const std::array<glm::dvec3, 3>& t, double reach) {
    const double longest =
        std::max({glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])});
    if (!(longest > 0.0)) return 0.0f;
    const double height = glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / longest;
    constexpr double mostSlender = 4.0;
    return longest * longest <= mostSlender * height * reach ? float(height) : 0.0f;
}

double ulpOf(const ShadowRay& ray, double reach) {
    return 0x1p-23 *
           std::max({reach, std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)});
}

}  // namespace penumbra
