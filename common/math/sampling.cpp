#include "common/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

std::uint32_t mix(std::uint32_t h) {  // "lowbias32" of C. Wellons' hash prospector, 2018
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    h ^= h >> 16;
    return h;
}

std::uint32_t reverseBits(std::uint32_t v) {
    v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
    return (v >> 16) | (v << 16);
}

/// Scrambles so that each bit is flipped by a hash of the more significant bits only: a random Owen scramble.
/// Every step carries information upwards in the reversed number, never down (constants: N. Vegdahl 2021,
/// tuned on Burley's scheme).
std::uint32_t owenScramble(std::uint32_t value, std::uint32_t seed) {
    std::uint32_t v = reverseBits(value);
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return reverseBits(v);
}

/// Second dimension of Sobol's sequence; the first is the bit reversal of the index.
std::uint32_t sobolSecond(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1) {
        if (index & 1u) result ^= direction;
    }
    return result;
}

bool isParallelogram(std::span<const glm::dvec3> p) {
    if (p.size() != 4) return false;
    // Summing four floats-turned-doubles rounds at 2^-52 of the coordinates; a quad further off than that is
    // not one.
    const glm::dvec3 gap = (p[0] - p[1]) + (p[2] - p[3]);
    const double scale =
        std::max({glm::length(p[0]), glm::length(p[1]), glm::length(p[2]), glm::length(p[3])});
    return glm::length(gap) <= 8.0 * 0x1p-52 * scale;
}

double triangleArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace

std::uint32_t hashSeed(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return mix(mix(mix(a + 0x9e3779b9u) ^ (b + 0x85ebca6bu)) ^ (c + 0xc2b2ae35u));
}

glm::dvec2 owenSobol(std::uint32_t index, std::uint32_t seed) {
    // Shuffling by an Owen scramble of the index keeps each aligned block of 2^k indices together, so
    // prefixes stay nets.
    const std::uint32_t shuffled = owenScramble(index, mix(seed));
    const std::uint32_t x = owenScramble(reverseBits(shuffled), mix(seed ^ 0x68bc21ebu));
    const std::uint32_t y = owenScramble(sobolSecond(shuffled), mix(seed ^ 0x02e5be93u));
    return glm::dvec2(x, y) * 0x1p-32;
}

glm::dvec3 pointInTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           const glm::dvec2& u) {
    glm::dvec2 t = u;
    if (t.y > t.x) {
        t.x *= 0.5;
        t.y -= t.x;
    } else {
        t.y *= 0.5;
        t.x -= t.y;
    }
    return a + t.x * (b - a) + t.y * (c - a);
}

double polygonArea(std::span<const glm::dvec3> polygon) {
    double area = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        area += triangleArea(polygon[0], polygon[i - 1], polygon[i]);
    return area;
}

glm::dvec3 pointInPolygon(std::span<const glm::dvec3> polygon, const glm::dvec2& u) {
    if (isParallelogram(polygon)) {
        return polygon[0] + u.x * (polygon[1] - polygon[0]) + u.y * (polygon[3] - polygon[0]);
    }
    double wanted = u.x * polygonArea(polygon);
    std::size_t last = 2;
    double area = triangleArea(polygon[0], polygon[1], polygon[2]);
    while (wanted >= area && last + 1 < polygon.size()) {
        wanted -= area;
        ++last;
        area = triangleArea(polygon[0], polygon[last - 1], polygon[last]);
    }
    const double stretched = area > 0.0 ? std::clamp(wanted / area, 0.0, 1.0) : 0.0;
    return pointInTriangle(polygon[0], polygon[last - 1], polygon[last], {stretched, u.y});
}

glm::dvec2 concentricDisk(const glm::dvec2& u) {
    const glm::dvec2 p = 2.0 * u - 1.0;
    if (p == glm::dvec2(0.0)) return p;
    constexpr double quarter = std::numbers::pi / 4.0;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const double radius = wide ? p.x : p.y;
    const double angle = wide ? quarter * (p.y / p.x) : 2.0 * quarter - quarter * (p.x / p.y);
    return radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

}  // namespace penumbra
