// Other ways to compute the same form factors, for the tests: slower or narrower, and written apart from the
// code under test.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "common/truth/polygon_light.h"

namespace penumbra {

using LongVec = glm::vec<3, long double>;

/// Square of side `side`, parallel to the receiver, `height` over its centre (any heat transfer handbook: 4
/// rectangles).
inline double centredSquareFormFactor(double side, double height) {
    const long double x = 0.5L * (long double)side / (long double)height;
    const long double root = std::sqrt(1.0L + x * x);
    return double(4.0L * (x / root * std::atan(x / root)) / std::numbers::pi_v<long double>);
}

/// Lambert's formula as it stands, 64-bit mantissa; relative to the receiver and above its horizon.
inline double longDoubleFormFactor(const glm::dvec3& normal, std::span<const glm::dvec3> polygon) {
    long double sum = 0.0L;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const LongVec a(polygon[i]), b(polygon[(i + 1) % polygon.size()]);
        const LongVec product = glm::cross(a, b - a);
        const long double l = std::sqrt(glm::dot(product, product));
        if (l > 0.0L) sum += glm::dot(LongVec(normal), product) * std::atan2(l, glm::dot(a, b)) / l;
    }
    return double(-sum / (2.0L * std::numbers::pi_v<long double>));
}

/// The defining integral of cos cos / (pi r^2) over a parallelogram, 5 x 5 Gauss-Legendre points: relative
/// error (size/distance)^10.
inline double gaussFormFactor(const glm::dvec3& normal, std::span<const glm::dvec3> parallelogram) {
    constexpr long double s = 0.538469310105683091036314420700208805L,
                          t = 0.906179845938663992797626878299392965L;
    constexpr long double ws = 0.478628670499366468041291514835638193L,
                          wt = 0.236926885056189087514264040719917363L;
    constexpr long double w0 = 128.0L / 225.0L;
    const std::array<std::array<long double, 2>, 5> rule = {{{-t, wt}, {-s, ws}, {0, w0}, {s, ws}, {t, wt}}};
    const LongVec origin(parallelogram[0]);
    const LongVec u = LongVec(parallelogram[1]) - origin, v = LongVec(parallelogram[3]) - origin;
    const LongVec areaVector = glm::cross(u, v);  // front
    long double sum = 0.0L;
    for (const auto& [pu, wu] : rule)
        for (const auto& [pv, wv] : rule) {
            const LongVec p = origin + u * (0.5L + 0.5L * pu) + v * (0.5L + 0.5L * pv);
            const long double rr = glm::dot(p, p);
            sum += wu * wv / 4.0L * glm::dot(LongVec(normal), p) * -glm::dot(areaVector, p) / (rr * rr);
        }
    return double(sum / std::numbers::pi_v<long double>);
}

/// What `n` x `n` jittered points of a parallelogram light see of it, each by its own ray: no clipping, no
/// cones.
inline double sampledFormFactor(const glm::dvec3& x, const glm::dvec3& normal,
                                std::span<const glm::dvec3> light, std::span<const Triangle> occluders,
                                int n) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const glm::dvec3 u = light[1] - light[0], v = light[3] - light[0];
    const glm::dvec3 areaVector = glm::cross(u, v);
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const int column = i % n, row = i / n;
        const glm::dvec3 d =
            light[0] + u * ((column + uniform(random)) / n) + v * ((row + uniform(random)) / n) - x;
        const double cosines = glm::dot(normal, d) * -glm::dot(areaVector, d);
        if (glm::dot(normal, d) <= 0.0 || cosines <= 0.0) continue;
        bool blocked = false;
        for (const Triangle& t : occluders) {  // Moeller & Trumbore, JGT 1997
            const glm::dvec3 e1 = t[1] - t[0], e2 = t[2] - t[0], p = glm::cross(d, e2), s = x - t[0];
            const double det = glm::dot(p, e1);
            const glm::dvec3 q = glm::cross(s, e1);
            const double a = glm::dot(s, p) / det, b = glm::dot(d, q) / det, along = glm::dot(e2, q) / det;
            blocked = blocked || (a >= 0.0 && b >= 0.0 && a + b <= 1.0 && along > 0.0 && along < 1.0);
        }
        if (!blocked) sum += cosines / (glm::dot(d, d) * glm::dot(d, d));
    }
    return sum / (double(n) * n * std::numbers::pi);
}

/// For a light and a triangle in parallel planes of constant z: the light's form factor minus that of the
/// light's intersection with the triangle's projection, in 2-D, by clipping half-plane by half-plane.
inline double polygonDifferenceFormFactor(const glm::dvec3& x, const glm::dvec3& normal,
                                          std::span<const glm::dvec3> light, const Triangle& t) {
    const double scale = (light[0].z - x.z) / (t[0].z - x.z);
    std::array<glm::dvec2, 3> shadow;
    for (std::size_t i = 0; i < 3; ++i)
        shadow[i] = glm::dvec2(x) + (glm::dvec2(t[i]) - glm::dvec2(x)) * scale;
    const auto side = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    const double winding = side(shadow[0], shadow[1], shadow[2]) < 0.0 ? -1.0 : 1.0;
    std::vector<glm::dvec3> common(light.begin(), light.end());
    for (std::size_t e = 0; e < 3; ++e) {
        std::vector<glm::dvec3> kept;
        for (std::size_t i = 0; i < common.size(); ++i) {
            const glm::dvec3& p = common[i];
            const glm::dvec3& q = common[(i + 1) % common.size()];
            const double sp = winding * side(shadow[e], shadow[(e + 1) % 3], glm::dvec2(p));
            const double sq = winding * side(shadow[e], shadow[(e + 1) % 3], glm::dvec2(q));
            if (sp >= 0.0) kept.push_back(p);
            if ((sp > 0.0 && sq < 0.0) || (sp < 0.0 && sq > 0.0))
                kept.push_back(glm::mix(p, q, sp / (sp - sq)));
        }
        common = kept;
    }
    const auto relative = [&](std::span<const glm::dvec3> polygon) {
        std::vector<glm::dvec3> moved;
        for (const glm::dvec3& p : polygon) moved.push_back(p - x);
        return longDoubleFormFactor(normal, moved);
    };
    return relative(light) - relative(common);
}

struct TiltedSquare {
    std::vector<glm::dvec3> corners;  ///< relative to the receiver
    glm::dvec3 normal;                ///< of the receiver
};

inline glm::dvec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> gauss;
    return glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
}

/// Rounded to a multiple of 2^-20, so that sums and differences of corners are exact: a true parallelogram at
/// any distance.
inline glm::dvec3 snapped(const glm::dvec3& p) {
    return glm::round(p * 1048576.0) / 1048576.0;
}

/// A parallelogram about a unit across, `distance` away, that faces the receiver at a cosine above 0.3,
/// wholly above its horizon.
inline TiltedSquare randomTiltedSquare(double distance, std::mt19937& random) {
    for (;;) {
        const glm::dvec3 centre = distance * randomDirection(random);
        const glm::dvec3 u = randomDirection(random);
        const glm::dvec3 v = glm::normalize(glm::cross(u, randomDirection(random)));
        const glm::dvec3 corner = snapped(centre - 0.5 * (u + v));
        TiltedSquare s{{corner, corner + snapped(u), corner + snapped(u) + snapped(v), corner + snapped(v)},
                       randomDirection(random)};
        const double facing = -glm::dot(glm::cross(u, v), centre) / glm::length(centre);
        if (facing < 0.3 || glm::dot(s.normal, centre) < 0.3 * distance) continue;
        bool above = true;
        for (const glm::dvec3& p : s.corners) above = above && glm::dot(s.normal, p) > 0.05 * distance;
        if (above) return s;
    }
}

}  // namespace penumbra
