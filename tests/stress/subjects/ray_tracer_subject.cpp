// The reference ray tracer and the exact scene's segments, against a slow and plain answer of 64 bits.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/truth/exact_scene.h"
#include "common/truth/ray_tracer.h"
#include "common/truth/segment_test.h"
#include "common/truth/shadow_packet.h"
#include "common/truth/surface_hit.h"
#include "tests/stress/case.h"
#include "tests/stress/dice.h"
#include "tests/stress/ray_oracle.h"
#include "tests/stress/triangle_shapes.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Rounding of a double, of the largest coordinate in play, with which crossTriangle and ShadowSegment may be
/// off: 16 and 8 roundings by their own bounds, and as many again of the three edges.
constexpr double doubleUlps = 64.0;

std::vector<Triangle> soup(const Case& given, Dice& dice) {
    std::vector<Triangle> triangles;
    const glm::dvec3 where = given.number("distance") / std::sqrt(3.0) * glm::dvec3(1.0);
    for (int i = 0; i < 3; ++i) {
        const TrianglePlace place{0.7 * dice.inCube(), dice.magnitude(0.05, 0.8), dice.direction()};
        for (Triangle t : trianglesOf(given.choice("shape"), place, dice)) {
            for (glm::dvec3& p : t) p = given.number("scale") * p + where;
            triangles.push_back(t);
        }
    }
    return triangles;
}

/// Anywhere on it; every third time near a corner or an edge, or on it.
glm::dvec2 barycentric(Dice& dice) {
    const double u = dice.oneIn(3) ? (dice.oneIn(3) ? 0.0 : dice.magnitude(1e-9, 1.0)) : dice.unit();
    return {u, (1.0 - u) * dice.unit()};
}

/// To a corner, an edge, an inside of some triangle or past it, or anywhere; or along the surface at the
/// case's angle.
ShadowRay shadowRay(const Case& given, const Scene& scene, Dice& dice) {
    const double size = std::max(scene.bounds.radius(), 1e-30);
    const auto own = std::uint32_t(dice.below(int(scene.triangleCount())));
    const Hit from = surfaceHit(scene, own, barycentric(dice));
    const Hit other =
        surfaceHit(scene, std::uint32_t(dice.below(int(scene.triangleCount()))), barycentric(dice));
    glm::dvec3 target = other.position;
    bool towardsInfinity = false;
    switch (dice.below(5)) {
        case 0:
            break;
        case 1:
            target += dice.magnitude(1e-9, 2.0) * (target - from.position);
            break;
        case 2:
            target = scene.bounds.centre() + 2.0 * size * dice.inCube();
            break;
        case 3: {
            const double angle = given.number("light-angle") * std::numbers::pi / 180.0;
            const glm::dvec3 n = from.geometricNormal;
            target = std::cos(angle) * n + std::sin(angle) * dice.across(n);
            towardsInfinity = dice.oneIn(2);
            if (!towardsInfinity) target = from.position + 2.0 * size * target;
            break;
        }
        default:
            target = dice.direction(), towardsInfinity = true;
            break;
    }
    ShadowRay ray = ShadowRay::from(from, target, towardsInfinity);
    if (dice.oneIn(4)) {  // in free space
        ray.origin = scene.bounds.centre() + 1.5 * size * dice.inCube();
        ray.normal = glm::dvec3(0.0), ray.triangle = ShadowRay::noTriangle, ray.edgeDistance = 0.0;
    }
    return ray;
}

struct Rays {
    std::vector<ShadowRay> rays;
    std::vector<BlockedBy> margins;
    double reach = 0.0;  ///< largest coordinate of the scene

    double floatUlps(std::size_t i, double length) const { return length / ulpOf(rays[i], reach); }
    double doubleUlpsOf(std::size_t i, double length) const {
        return length / (0x1p-29 * ulpOf(rays[i], reach));
    }

    /// What floats answer: a ray that is free must be so to `decisiveUlps`, and one that is blocked to the
    /// last digits of a double.
    void judgeFloats(Verdict& verdict, const std::vector<std::uint8_t>& blocked,
                     const std::string& name) const {
        double free = 0.0, shadowed = 0.0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (blocked[i]) shadowed = std::max(shadowed, doubleUlpsOf(i, -margins[i].known));
            if (!blocked[i]) free = std::max(free, floatUlps(i, margins[i].exact));
        }
        verdict.expectAtMost(name + ": light through a triangle, float ulps inside", free, decisiveUlps);
        verdict.expectAtMost(name + ": blocked by a triangle, double ulps beside", shadowed, doubleUlps);
    }
    void judgeDoubles(Verdict& verdict, const std::vector<std::uint8_t>& blocked,
                      const std::string& name) const {
        double wrong = 0.0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            wrong = std::max(wrong, doubleUlpsOf(i, blocked[i] ? -margins[i].known : margins[i].known));
        verdict.expectAtMost(name + ": wrong by double ulps", wrong, doubleUlps);
    }
};

void shadows(Verdict& verdict, const Case& given, const RayTracer& tracer, Dice& dice) {
    constexpr int count = 40;  // two packets and a half
    const Scene& scene = tracer.scene();
    const std::vector<Triangle> triangles = trianglesIn(scene);
    Rays rays;
    rays.reach = largestCoordinate(scene.bounds);
    for (int i = 0; i < count; ++i) {
        rays.rays.push_back(shadowRay(given, scene, dice));
        rays.margins.push_back(blockedBy(rays.rays.back(), triangles));
    }
    std::vector<std::uint8_t> together(count), alone(count), exact(count), plain(count);
    tracer.occluded(rays.rays, together);
    const ExactScene exactScene(scene);
    for (std::size_t i = 0; i < count; ++i) {
        const ShadowRay& ray = rays.rays[i];
        tracer.occluded({&ray, 1}, {&alone[i], 1});
        exact[i] = exactScene.occluded(
            ray.origin, ray.triangle,
            ray.towardsInfinity
                ? ray.origin + 10.0 * (rays.reach + glm::length(ray.origin)) * glm::normalize(ray.target)
                : ray.target);
        for (std::size_t t = 0; t < triangles.size(); ++t)
            if (t != ray.triangle && crossTriangle({ray.origin, ray.target, ray.towardsInfinity},
                                                   triangles[t]) == Crossing::inside)
                plain[i] = 1;
    }
    rays.judgeDoubles(verdict, plain, "triangle by triangle");
    rays.judgeFloats(verdict, together, "packets");
    rays.judgeFloats(verdict, alone, "single rays");
    rays.judgeDoubles(verdict, exact, "exact scene");
}

/// Of a triangle as it is seen along `d`: its longest edge over its smallest height.
///
/// The hit of a camera ray is put on the triangle by barycentric coordinates, and what is off by x sideways
/// in one of them, over a height, moves the hit by x times the slenderness s. In double ulps (2^-52 L, L the
/// largest coordinate in play), with R <= 2 sqrt(3) L the distance of the farthest corner:
/// - 3.5 s: the corners relative to the eye, sqrt(3) / 2 at either end of an edge, for two coordinates.
/// - 28 s: the two edge functions d . (a + b) x (b - a), seven roundings of a sum of products below
///   2 / sqrt(3) |b - a| 2 R each: 14, as in shadow_packet.h, for floats.
/// - 14 s: their sum, by which both are divided; together they are at most 1.
/// - 8, of any triangle: a + u (b - a) + v (c - a), and the ray's own direction, of length 1 but for its
/// rounding,
///   over the distance R.
/// With s >= 2 / sqrt(3) that is less than 53 s: `doubleUlps` holds it. The worst that was found is on the
/// page.
double slenderness(const Triangle& t, const glm::dvec3& d) {
    const double longest =
        std::max({glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])});
    return longest * longest / std::abs(glm::dot(d, glm::cross(t[1] - t[0], t[2] - t[0])));
}

/// What a camera sees: nothing nearer that is surely there, and a point on the ray and on the triangle.
void primary(Verdict& verdict, const RayTracer& tracer, Dice& dice) {
    const Scene& scene = tracer.scene();
    const std::vector<Triangle> triangles = trianglesIn(scene);
    const double size = std::max(scene.bounds.radius(), 1e-30);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 eye = scene.bounds.centre() + size * dice.magnitude(1.0, 100.0) * dice.direction();
        const Hit aim =
            surfaceHit(scene, std::uint32_t(dice.below(int(triangles.size()))), barycentric(dice));
        if (!(glm::length(aim.position - eye) > 0.0)) continue;
        const Ray ray{eye, glm::normalize(aim.position - eye)};
        const ShadowRay endless{.origin = eye, .target = ray.direction, .towardsInfinity = true};
        const double ulp = ulpOf(endless, largestCoordinate(scene.bounds));
        const Hit hit = tracer.nearest(ray);
        double nearest = infinity;
        for (const Triangle& t : triangles)
            if (crossingMargin(endless, t).exact() > decisiveUlps * ulp)
                nearest = std::min(nearest, alongTo(ray, t));
        verdict.expectAtMost("eye: nothing is hit where something is",
                             !hit.valid && nearest < infinity ? 1.0 : 0.0, 0.0);
        if (!hit.valid) continue;
        const glm::dvec3 to = hit.position - eye;
        verdict.expectAtMost("eye: hit off its ray, float ulps",
                             glm::length(glm::cross(to, ray.direction)) / ulp, decisiveUlps);
        if (crossingMargin(endless, triangles[hit.triangle]).exact() > decisiveUlps * ulp) {
            verdict.expectAtMost("eye: hit inside a triangle off its ray, double ulps over its slenderness",
                                 glm::length(glm::cross(to, ray.direction)) / (0x1p-29 * ulp) /
                                     slenderness(triangles[hit.triangle], ray.direction),
                                 doubleUlps);
            verdict.expectAtMost("eye: hit behind what is nearer, float ulps",
                                 (alongTo(ray, triangles[hit.triangle]) - nearest) / ulp, decisiveUlps);
        }
    }
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(std::uint64_t(given.integer("variant")));
    const Scene scene = sceneOf(soup(given, dice));
    const RayTracer tracer(scene);
    shadows(verdict, given, tracer, dice);
    primary(verdict, tracer, dice);
    return verdict;
}

const AddSubject rayTracer(
    {.name = "ray-tracer",
     .claim = "shadow rays and camera rays, in packets, one by one and in double, agree with "
              "a plain test of every triangle",
     .axes = {"shape", "light-angle", "scale", "distance", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
