#include "common/truth/direction_moments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double pi = std::numbers::pi;
constexpr glm::dvec3 up(0.0, 0.0, 1.0);

/// The edge integrals of the head of this file, divided as they are added up.
struct EdgeSums {
    double solidAngle = 0.0;
    glm::dvec3 first{0.0};   // int w x dw: twice the first moment
    glm::dvec3 second{0.0};  // int w (w x dw).z

    DirectionMoments moments(double scale) const {
        return {scale * solidAngle, 0.5 * scale * first, scale / 3.0 * (solidAngle * up + second)};
    }
};

/// Adds evenly spaced points of a rim, the first at angle `start`.
void addRim(EdgeSums& sums, const glm::dvec3& centre, const glm::dvec3& u, const glm::dvec3& v, int count,
            double start) {
    for (int i = 0; i < count; ++i) {
        const double angle = start + 2.0 * pi * i / count;
        const glm::dvec3 p = centre + std::cos(angle) * u + std::sin(angle) * v;
        const glm::dvec3 pxdp = glm::cross(p, std::cos(angle) * v - std::sin(angle) * u);
        const double squared = glm::dot(p, p), length = std::sqrt(squared);
        // (1 - cos) dphi about +z, which is enough above the horizon: -z is not in the region.
        sums.solidAngle += pxdp.z / (length * (length + p.z));
        sums.first += pxdp / squared;
        sums.second += pxdp.z / (squared * length) * p;
    }
}

double largestDifference(const DirectionMoments& a, const DirectionMoments& b) {
    const glm::dvec3 first = glm::abs(a.first - b.first), second = glm::abs(a.second - b.second);
    return std::max(
        {std::abs(a.solidAngle - b.solidAngle), first.x, first.y, first.z, second.x, second.y, second.z});
}

/// Solid angle of a triangle of unit vectors, in an order that makes its edges' a x b point inwards.
double triangleSolidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double volume = glm::dot(a, glm::cross(b, c));
    return 2.0 * std::atan2(volume, 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

}  // namespace

DirectionMoments hemisphereMoments() {
    return {2.0 * pi, pi * up, 2.0 * pi / 3.0 * up};
}

// All the angles come from one root, k: the horizon's arc in the cap is 2 atan2(k, cos s), the cap's arc
// above the horizon 2 atan2(k, -cos b cos s) of its own circle, and the two arcs meet at the angle
// pi - atan2(k, cos b). So the cap that just touches the horizon, where k loses half its digits, loses none
// here: what is wrong with k cancels. k = 0 gives the cap that is whole, and the one that is wholly below.
DirectionMoments capMoments(const glm::dvec3& axis, double sine, double cosine) {
    const double cosB = axis.z, sinB = std::hypot(axis.x, axis.y);
    // The same twice; by the smaller of the two. A sphere that touches x would else keep half its digits.
    const double squared =
        std::abs(cosB) < sinB ? (sine - cosB) * (sine + cosB) : (sinB - cosine) * (sinB + cosine);
    const double k = std::sqrt(std::max(0.0, squared));
    const double r = k > 0.0 ? k / (k * k + cosine * cosine) : 0.0;  // k / sin^2 b
    const double p = std::atan2(k, -cosB * cosine);
    const double halfHorizonArc = std::atan2(k, cosine);
    // In the cap's circle, towards the normal: up - cosB axis, and axis - cosB up.
    const glm::dvec3 across(-cosB * axis.x, -cosB * axis.y, sinB * sinB);
    const glm::dvec3 horizontal(axis.x, axis.y, 0.0);
    const double pSine2 = p * sine * sine;

    DirectionMoments m;
    m.solidAngle = 2.0 * (pi - p * cosine - std::atan2(k, cosB));
    m.first = pSine2 * axis - cosine * r * across + halfHorizonArc * up;
    const glm::dvec3 capArc = 2.0 * cosine * (cosine * k - pSine2 * cosB) * axis +
                              (cosine * (pSine2 - r * cosB * cosine) - 2.0 * sine * sine * cosB * r) * across;
    m.second = (m.solidAngle * up + 2.0 * r * horizontal - capArc) / 3.0;
    return m;
}

DirectionMoments wedgeMoments(double from, double to) {
    const double c0 = std::cos(from), s0 = std::sin(from), c1 = std::cos(to), s1 = std::sin(to);
    return {2.0 * (to - from), 0.5 * pi * glm::dvec3(s1 - s0, 0.0, c0 - c1),
            2.0 / 3.0 * glm::dvec3(s1 * s1 - s0 * s0, 0.0, to - from - s1 * c1 + s0 * c0)};
}

DirectionMoments polygonMoments(std::span<const glm::dvec3> corners) {
    EdgeSums sums;
    const glm::dvec3 first = glm::normalize(corners[0]);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 b = glm::normalize(corners[i]);
        const glm::dvec3 a = glm::normalize(corners[(i + 1) % corners.size()]);
        const glm::dvec3 axb = glm::cross(a, b);
        const double sine = glm::length(axb), cosine = glm::dot(a, b);
        if (sine == 0.0) continue;
        const glm::dvec3 inward = axb / sine;
        sums.solidAngle += triangleSolidAngle(first, a, b);
        sums.first += std::atan2(sine, cosine) * inward;
        // int w ds along the arc: by symmetry along a + b, and as long as the chord.
        sums.second += inward.z * sine / (1.0 + cosine) * (a + b);
    }
    return sums.moments(1.0);
}

DirectionMoments diskMoments(const glm::dvec3& centre, const glm::dvec3& u, const glm::dvec3& v) {
    int count = 16;
    EdgeSums sums;
    addRim(sums, centre, u, v, count, 0.0);
    DirectionMoments moments = sums.moments(2.0 * pi / count), coarser;
    do {
        coarser = moments;
        addRim(sums, centre, u, v, count, pi / count);  // between those that are there
        count *= 2;
        moments = sums.moments(2.0 * pi / count);
    } while (largestDifference(moments, coarser) > 1e-14 && count < (1 << 20));
    return moments;
}

}  // namespace penumbra
