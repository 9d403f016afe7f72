// Rays and closed convex bodies: nothing leaks out through an edge or a corner, and no body shadows itself.
#include <algorithm>
#include <cmath>

#include "common/truth/exact_scene.h"
#include "common/truth/ray_tracer.h"
#include "common/truth/shadow_packet.h"
#include "common/truth/surface_hit.h"
#include "tests/stress/closed_body.h"
#include "tests/stress/ray_oracle.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

constexpr int count = 48;

std::uint32_t anyTriangle(const Scene& scene, Dice& dice) {
    return std::uint32_t(dice.below(int(scene.triangleCount())));
}

/// A corner of the body, a point of an edge, or one of a face.
glm::dvec3 aim(const Scene& scene, Dice& dice) {
    const int kind = dice.below(3);
    const double u = dice.unit();
    const glm::dvec2 barycentric =
        kind == 0 ? glm::dvec2(1.0, 0.0) : glm::dvec2(u, kind == 1 ? 0.0 : dice.unit() * (1.0 - u));
    return surfaceHit(scene, anyTriangle(scene, dice), barycentric).position;
}

/// Is `p` inside, even if it is moved by `margin` metres?
bool deepInside(const std::vector<Triangle>& triangles, const glm::dvec3& p, double margin) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-margin, margin}) {
            glm::dvec3 moved = p;
            moved[axis] += side;
            if (windingNumber(triangles, moved) < 0.5) return false;
        }
    return true;
}

/// How far from the nearest corner of the body the ray passes, float ulps. Where the signs of all edges that
/// meet at a corner are wrong, each by its own rounding, Embree finds no triangle at all (ray_tracer.h).
double fromCorner(const Scene& scene, const ShadowRay& ray) {
    const glm::dvec3 d = glm::normalize(ray.towardsInfinity ? ray.target : ray.target - ray.origin);
    double least = scene.bounds.radius();
    for (const glm::vec3& p : scene.positions)
        least = std::min(least, glm::length(glm::cross(glm::dvec3(p) - ray.origin, d)));
    return least / floatUlp(scene);
}

/// From inside, in free space, through whatever it is, to a point that is outside.
void outwards(Verdict& verdict, const RayTracer& tracer, const ExactScene& exact, Dice& dice) {
    const Scene& scene = tracer.scene();
    const std::vector<Triangle> triangles = trianglesIn(scene);
    const double ulp = floatUlp(scene), size = scene.bounds.radius();
    std::vector<ShadowRay> rays;
    for (int i = 0; i < count; ++i) {
        ShadowRay ray;
        ray.origin = scene.bounds.centre() + 0.3 * dice.unit() * (aim(scene, dice) - scene.bounds.centre());
        const glm::dvec3 through =
            aim(scene, dice) + dice.below(3) * dice.magnitude(1e-9, 16.0) * ulp * dice.inCube();
        ray.towardsInfinity = dice.oneIn(3);
        ray.target = ray.towardsInfinity ? through - ray.origin
                                         : ray.origin + dice.between(2.0, 9.0) * (through - ray.origin);
        // So far that rounding cannot bring it back.
        const bool ends = ray.towardsInfinity ||
                          glm::distance(ray.target, scene.bounds.centre()) > 1.01 * size + 64.0 * ulp;
        if (ends && glm::length(ray.target - ray.origin) > 0.0 &&
            deepInside(triangles, ray.origin, 64.0 * ulp))
            rays.push_back(ray);
    }
    std::vector<std::uint8_t> blocked(rays.size());
    tracer.occluded(rays, blocked);
    double leaks = 0.0, exactLeaks = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 end = rays[i].towardsInfinity
                                   ? rays[i].origin + 100.0 * size * glm::normalize(rays[i].target)
                                   : rays[i].target;
        if (!blocked[i]) leaks = std::max(leaks, fromCorner(scene, rays[i]));
        exactLeaks += exact.occluded(rays[i].origin, noTriangle, end) ? 0.0 : 1.0;
    }
    verdict.expectAtMost("a ray leaks out so far from a corner, float ulps", leaks, decisiveUlps);
    verdict.expectAtMost("segments that leak out", exactLeaks, 0.0);
}

/// From the inside of its wall: blocked by another wall, also next to the fold.
void fromTheWall(Verdict& verdict, const RayTracer& tracer, Dice& dice) {
    const Scene& scene = tracer.scene();
    const std::vector<Triangle> triangles = trianglesIn(scene);
    const double ulp = floatUlp(scene), size = scene.bounds.radius();
    double leaks = 0.0;
    for (int i = 0; i < count / 2; ++i) {
        const double near = dice.oneIn(2) ? dice.magnitude(1e-7, 1.0) : dice.unit();
        const Hit from =
            surfaceHit(scene, anyTriangle(scene, dice), {near, (1.0 - near) * dice.between(0.1, 0.9)});
        const glm::dvec3 d = glm::normalize(aim(scene, dice) - from.position + 0.1 * size * dice.inCube());
        const double descent = -glm::dot(d, from.geometricNormal);
        if (!(descent > 0.1) || from.edgeDistance < ulp) continue;
        if (windingNumber(triangles, from.position + 0.01 * ulp * d) < 0.5) continue;
        // The lifted ray must not begin beyond the wall on the other side; next to a fold that is looked
        // into.
        const double lift = decisiveUlps * ulp;
        if (from.edgeDistance > lift &&
            windingNumber(triangles, from.position - lift * from.geometricNormal) < 0.5)
            continue;
        if (!tracer.occludedTowards(from, d))
            leaks = std::max(leaks, fromCorner(scene, ShadowRay::from(from, d, true)));
    }
    verdict.expectAtMost("a ray from a wall leaks out so far from a corner, float ulps", leaks, decisiveUlps);
}

/// From outside of a face away from it: blocked only where rounding has made a dent.
void shadowsItself(Verdict& verdict, const RayTracer& tracer, Dice& dice) {
    const Scene& scene = tracer.scene();
    const std::vector<Triangle> triangles = trianglesIn(scene);
    double wrong = 0.0;
    for (int i = 0; i < count / 2; ++i) {
        const double near = dice.oneIn(2) ? dice.magnitude(1e-9, 1.0) : dice.unit();
        const Hit from = surfaceHit(scene, anyTriangle(scene, dice), {near, (1.0 - near) * dice.unit()});
        const double angle = 0.5 * std::numbers::pi - dice.magnitude(1e-6, 1.5);
        const glm::dvec3 d =
            std::cos(angle) * from.geometricNormal + std::sin(angle) * dice.across(from.geometricNormal);
        const ShadowRay ray = ShadowRay::from(from, d, true);
        if (tracer.occludedTowards(from, d))
            wrong = std::max(wrong, -blockedBy(ray, triangles).known / (0x1p-29 * floatUlp(scene)));
    }
    verdict.expectAtMost("it shadows itself, double ulps beside", wrong, 64.0);
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(std::uint64_t(given.integer("variant")));
    const Scene scene = closedBody(given, 1e-4, dice);
    const RayTracer tracer(scene);
    outwards(verdict, tracer, ExactScene(scene), dice);
    fromTheWall(verdict, tracer, dice);
    shadowsItself(verdict, tracer, dice);
    return verdict;
}

const AddSubject closedBodies(
    {.name = "closed-body",
     .claim = "no ray leaks out of a closed convex body, through an edge or a corner "
              "either, and none is blocked by its own surface",
     .axes = {"scale", "distance", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
