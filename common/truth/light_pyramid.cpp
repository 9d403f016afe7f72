#include "common/truth/light_pyramid.h"

#include <cmath>
#include <limits>

#include "common/truth/lambert_polygon.h"

namespace penumbra {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// `p` times the power of two that brings its largest coordinate into [1, 2): the same direction, exactly.
glm::dvec3 equallyFar(const glm::dvec3& p) {
    const glm::dvec3 size = glm::abs(p);
    const double largest = std::max({size.x, size.y, size.z});
    return largest > 0.0 ? p * std::scalbn(1.0, std::min(-std::ilogb(largest), 1000)) : p;
}

/// Corners of a wide light may be a thousand times farther than their neighbours, and Lambert's formula,
/// which asks for directions only, would lose as much of its digits.
Polygon3 equallyFar(const Polygon3& polygon) {
    Polygon3 result;
    for (const glm::dvec3& p : polygon.span()) result.push(equallyFar(p));
    return result;
}

bool isWide(const LightPyramid& pyramid, const Polygon3& light) {
    constexpr double most = heightsOfAWideLight;
    double farthest = 0.0;
    for (const glm::dvec3& p : light.span()) farthest = std::max(farthest, glm::dot(p, p));
    return most * most * pyramid.height * pyramid.height < farthest;
}

Polygon3 clipToQuadrant(const Polygon3& light, const glm::dvec3& lightNormal, Quadrant quadrant) {
    const glm::dvec3 size = glm::abs(lightNormal);
    glm::dvec3 axis(0.0);
    axis[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
    const glm::dvec3 u = glm::cross(lightNormal, axis), v = glm::cross(lightNormal, u);
    const double uSign = quadrant == Quadrant::first || quadrant == Quadrant::second ? 1.0 : -1.0;
    const double vSign = quadrant == Quadrant::first || quadrant == Quadrant::third ? 1.0 : -1.0;
    const Polygon3 half = clip(light, [&](const glm::dvec3& p) { return uSign * glm::dot(u, p); });
    return clip(half, [&](const glm::dvec3& p) { return vSign * glm::dot(v, p); });
}

}  // namespace

LightPyramid lightPyramid(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                          Quadrant quadrant) {
    LightPyramid pyramid;
    pyramid.x = x;
    pyramid.normal = n;
    const glm::dvec3 areaVector = areaNormal(polygon);
    const double length = glm::length(areaVector);
    if (!(length > 0.0)) return pyramid;
    Polygon3 light;
    for (const glm::dvec3& p : polygon) light.push(p - x);
    pyramid.lightNormal = areaVector / length;
    pyramid.height = -glm::dot(pyramid.lightNormal, light[0]);
    // Rounding of the input: x and the scene's points carry half a unit in the last place each, a computed x
    // a little more.
    pyramid.rounding = 8.0 * epsilon * (sumOfMagnitudes(x) + sumOfMagnitudes(light[0]));
    if (pyramid.height <= pyramid.rounding) return pyramid;  // behind the light, or in its plane
    pyramid.wide = isWide(pyramid, light);
    if (quadrant != Quadrant::all) light = clipToQuadrant(light, pyramid.lightNormal, quadrant);
    pyramid.light = clip(light, [&](const glm::dvec3& p) { return glm::dot(n, p); });
    for (int i = 0; i < pyramid.light.count; ++i)
        pyramid.inward.push(-edgePlane(pyramid.light[i], pyramid.light[pyramid.light.next(i)]));
    pyramid.inward.push(n);
    return pyramid;
}

bool outside(const LightPyramid& pyramid, const Aabb& box) {
    const glm::dvec3 centre = box.centre() - pyramid.x;
    const glm::dvec3 half = 0.5 * box.size();
    // Outward, so that rounding never culls what the exact test would keep.
    const double slack = 1.0 + 16.0 * epsilon;
    const double slackLength = 16.0 * epsilon * (sumOfMagnitudes(centre) + sumOfMagnitudes(pyramid.x));
    const auto nearest = [&](const glm::dvec3& normal) {
        const glm::dvec3 size = glm::abs(normal);
        return glm::dot(normal, centre) + slack * glm::dot(size, half) + slackLength * sumOfMagnitudes(size);
    };
    for (const glm::dvec3& inward : pyramid.inward.span())
        if (nearest(inward) < 0.0) return true;
    return nearest(pyramid.lightNormal) + pyramid.height < 0.0;
}

double formFactorOf(const LightPyramid& pyramid, const Polygon3& part) {
    if (pyramid.wide) return lambertFormFactor(pyramid.normal, equallyFar(part));
    return lambertFormFactor(pyramid.normal, part);
}

}  // namespace penumbra
