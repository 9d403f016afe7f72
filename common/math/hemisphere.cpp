#include "common/math/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/math/sampling.h"

namespace penumbra {

namespace {

/// Unit vector at height z, `turn` of the way round; `sine` is its distance from the axis.
glm::dvec3 around(double turn, double sine, double z) {
    const double angle = 2.0 * std::numbers::pi * turn;
    return {sine * std::cos(angle), sine * std::sin(angle), z};
}

/// z = 1 - 2v: spheres are as wide as their enclosing cylinder (Archimedes), so even heights are even areas.
glm::dvec3 onSphere(double v, double turn) {
    return around(turn, 2.0 * std::sqrt(v * (1.0 - v)), 1.0 - 2.0 * v);
}

}  // namespace

glm::dmat3 frameAround(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            glm::dvec3(b, sign + n.y * n.y * a, -n.y), n};
}

glm::dvec3 cosineDirection(const glm::dvec2& u) {
    const glm::dvec2 d = concentricDisk(u);
    return {d, std::sqrt(std::max(0.0, 1.0 - glm::dot(d, d)))};
}

glm::dvec3 uniformDirection(const glm::dvec2& u) {
    return around(u.y, std::sqrt(u.x * (2.0 - u.x)), 1.0 - u.x);
}

glm::dvec3 fibonacciSphere(int index, int count) {
    const double turns = index * (std::numbers::phi - 1.0);
    return onSphere((index + 0.5) / count, turns - std::floor(turns));
}

std::vector<glm::dvec3> owenSobolSphere(int count, std::uint32_t seed) {
    std::vector<glm::dvec3> directions;
    directions.reserve(std::size_t(count));
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 u = owenSobol(std::uint32_t(i), seed);
        directions.push_back(onSphere(u.x, u.y));
    }
    return directions;
}

}  // namespace penumbra
