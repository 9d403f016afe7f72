#include "tests/stress/ray_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace penumbra::stress {
namespace {

using Real = long double;
using Vector = glm::vec<3, Real>;
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

CrossingMargin crossingMargin(const ShadowRay& ray, const Triangle& triangle) {
    const Vector origin(ray.origin), target(ray.target), d = ray.towardsInfinity ? target : target - origin;
    const std::array<Vector, 3> p = {Vector(triangle[0]) - origin, Vector(triangle[1]) - origin,
                                     Vector(triangle[2]) - origin};
    const Vector normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const Real area = glm::length(normal), descent = glm::dot(d, normal);
    if (!(area > 0) || descent == 0) return {-infinity, -infinity, 1.0};
    const Real side = descent > 0 ? 1 : -1;
    const Real start = side * glm::dot(normal, p[0]) / area;
    const Real end = ray.towardsInfinity ? std::numeric_limits<Real>::infinity()
                                         : side * glm::dot(normal, d - p[0]) / area;
    Real sideways = std::numeric_limits<Real>::infinity(), longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector &a = p[i], &b = p[(i + 1) % 3], edge = b - a;
        const Real across = glm::length(glm::cross(d, edge));
        // Along an edge it is on the border.
        const Real inside = across > 0 ? side * glm::dot(d, glm::cross(a, edge)) / across : 0;
        sideways = std::min(sideways, inside);
        longest = std::max(longest, glm::length(edge));
    }
    return {double(sideways), double(std::min(start, end)), double(area / (longest * longest))};
}

BlockedBy blockedBy(const ShadowRay& ray, const std::vector<Triangle>& triangles) {
    BlockedBy most{-infinity, -infinity};
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (t == ray.triangle) continue;
        const CrossingMargin margin = crossingMargin(ray, triangles[t]);
        most.exact = std::max(most.exact, margin.exact());
        most.known = std::max(most.known, margin.known());
    }
    return most;
}

double alongTo(const Ray& ray, const Triangle& triangle) {
    const Vector a = Vector(triangle[0]) - Vector(ray.origin);
    const Vector normal =
        glm::cross(Vector(triangle[1]) - Vector(triangle[0]), Vector(triangle[2]) - Vector(triangle[0]));
    const Real descent = glm::dot(normal, Vector(ray.direction));
    return descent == 0 ? infinity : double(glm::dot(normal, a) / descent);
}

double windingNumber(const std::vector<Triangle>& triangles, const glm::dvec3& p) {
    Real sum = 0;
    for (const Triangle& t : triangles) {
        const Vector a = Vector(t[0]) - Vector(p), b = Vector(t[1]) - Vector(p), c = Vector(t[2]) - Vector(p);
        const Real la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const Real volume = glm::dot(a, glm::cross(b - a, c - a));
        sum += 2 * std::atan2(volume,
                              la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return double(sum / (4 * std::numbers::pi_v<Real>));
}

}  // namespace penumbra::stress
