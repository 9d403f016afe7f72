#include "tests/stress/triangle_shapes.h"

#include <algorithm>
#include <utility>

namespace penumbra::stress {
namespace {

Triangle ordinary(const TrianglePlace& where, Dice& dice) {
    Triangle t;
    for (glm::dvec3& p : t) p = where.centre + where.size * dice.inCube();
    return t;
}

/// `flatness`: of the height to the length; `foot`: where along the longest edge the third corner stands.
Triangle flat(const TrianglePlace& where, double flatness, double foot, Dice& dice) {
    const glm::dvec3 along = dice.direction();
    const glm::dvec3 start = where.centre - where.size * along;
    return {start, start + 2.0 * where.size * along,
            start + 2.0 * where.size * (foot * along + flatness * dice.across(along))};
}

Triangle withoutArea(const TrianglePlace& where, Dice& dice) {
    const Triangle t = ordinary(where, dice);
    switch (dice.below(4)) {
        case 0:
            return {t[0], t[0], t[1]};
        case 1:
            return {t[0], t[1], t[0]};
        case 2:
            return {t[0], t[0], t[0]};
        default:
            return {t[0], 0.5 * (t[0] + t[1]), t[1]};
    }
}

/// A strip of neighbours, and one that lies over them, anyhow in one plane.
std::vector<Triangle> coplanar(const TrianglePlace& where, Dice& dice) {
    const glm::dvec3 normal = dice.oneIn(2) ? where.plane : dice.direction();
    const glm::dvec3 u = where.size * dice.across(normal);
    const glm::dvec3 v = glm::cross(normal, u);
    const auto at = [&](double s, double t) { return where.centre + s * u + t * v; };
    std::vector<Triangle> strip;
    for (int i = 0; i < 3; ++i) {
        const double s = 0.7 * i - 1.0;
        strip.push_back({at(s, -0.5), at(s + 0.7, -0.5), at(s + 0.7, 0.6)});
        strip.push_back({at(s, -0.5), at(s + 0.7, 0.6), at(s, 0.6)});
    }
    strip.push_back({at(-0.3, -0.9), at(0.8, 0.1), at(-0.6, dice.unit())});
    return strip;
}

std::vector<Triangle> coincident(const TrianglePlace& where, Dice& dice) {
    const Triangle t = ordinary(where, dice);
    std::vector<Triangle> same = {t, {t[1], t[2], t[0]}, {t[2], t[1], t[0]}};
    if (dice.oneIn(2)) same.push_back(t);
    return same;
}

std::vector<Triangle> interpenetrating(const TrianglePlace& where, Dice& dice) {
    std::vector<Triangle> star;
    for (int i = 0; i < 5; ++i) {
        const glm::dvec3 a = dice.direction(), b = dice.across(a);
        // The place's centre lies inside each.
        star.push_back({where.centre + where.size * a, where.centre + where.size * (b - 0.5 * a),
                        where.centre - where.size * (b + 0.5 * a)});
    }
    return star;
}

}  // namespace

std::vector<Triangle> trianglesOf(const std::string& shape, const TrianglePlace& where, Dice& dice) {
    if (shape == "coplanar") return coplanar(where, dice);
    if (shape == "coincident") return coincident(where, dice);
    if (shape == "interpenetrating") return interpenetrating(where, dice);
    std::vector<Triangle> triangles;
    const int count = 1 + dice.below(4);
    for (int i = 0; i < count; ++i) {
        const double thin = dice.magnitude(1e-14, 1e-3);
        if (shape == "needle")
            triangles.push_back(flat(where, thin, dice.oneIn(2) ? 0.0 : 1.0, dice));
        else if (shape == "sliver")
            triangles.push_back(flat(where, thin, dice.between(0.1, 0.9), dice));
        else
            triangles.push_back(shape == "degenerate" ? withoutArea(where, dice) : ordinary(where, dice));
        std::rotate(triangles.back().begin(), triangles.back().begin() + dice.below(3),
                    triangles.back().end());
    }
    return triangles;
}

}  // namespace penumbra::stress
