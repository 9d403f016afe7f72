// What a point sees of the sky by exact rays, its bent normal, and the light of linear skies.
#include <algorithm>
#include <cmath>

#include "chapters/11_bent_normals/sh_irradiance.h"
#include "common/truth/surface_hit.h"
#include "tests/stress/bent_bound.h"
#include "tests/stress/closed_body.h"
#include "tests/stress/ray_oracle.h"
#include "tests/stress/triangle_shapes.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

Hit anywhere(const Scene& scene, Dice& dice) {
    const double u = dice.oneIn(3) ? dice.magnitude(1e-9, 1.0) : dice.unit();
    Hit hit = surfaceHit(scene, std::uint32_t(dice.below(int(scene.triangleCount()))),
                         {u, (1.0 - u) * dice.unit()});
    if (dice.oneIn(2)) hit.geometricNormal = -hit.geometricNormal;  // the back of it
    return hit;
}

void seen(Verdict& verdict, const Case& given, const RayTracer& tracer, Dice& dice) {
    const Hit hit = anywhere(tracer.scene(), dice);
    // A shading normal may lean away from the surface; what is below the surface is dark.
    const glm::dvec3 normal =
        glm::normalize(hit.geometricNormal + (dice.oneIn(2) ? 0.0 : 0.5) * dice.direction());
    AmbientRays rays;
    rays.count = given.integer("samples");
    rays.weighting = dice.oneIn(2) ? Weighting::cosine : Weighting::uniform;
    const std::uint32_t seed = std::uint32_t(dice.below(1000));
    std::int64_t traced = 0;
    const auto all = castAmbientRays(tracer, hit, normal, rays, seed, traced);
    const AmbientValue value = averageOf(all);
    verdict.expectAtMost("visibility beyond 1", value.visibility - 1.0, 0.0);
    verdict.expectAtMost("visibility below 0", -value.visibility, 0.0);
    verdict.expectAtMost(
        "bent vector longer than its visibility allows, over the rays' discrepancy",
        (glm::length(value.bent) - longestBent(value.visibility, rays.weighting)) / discrepancy(rays.count),
        1.0);
    verdict.expectAtMost("length of the bent normal, off 1",
                         std::abs(glm::length(bentNormal(value, normal)) - 1.0), 1e-15);
    rays.reach.range = given.number("scale") * dice.magnitude(1e-3, 10.0);
    const auto hard = castAmbientRays(tracer, hit, normal, rays, seed, traced);
    rays.reach.smooth = true;
    const auto smooth = castAmbientRays(tracer, hit, normal, rays, seed, traced);
    double darker = 0.0, outside = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        darker = std::max({darker, all[i].open - hard[i].open, hard[i].open - smooth[i].open});
        outside = std::max({outside, -smooth[i].open, smooth[i].open - 1.0});
    }
    // Two rays of one direction may part at a border: 64 ulps, as in ray-tracer.
    verdict.measure("a direction that a range darkens", darker);
    verdict.expectAtMost("openness outside of [0,1]", outside, 0.0);
}

/// E = pi (mean A + gradient Bc) is the sum over the rays, for any sky that is linear.
void linearSky(Verdict& verdict, const RayTracer& tracer, Dice& dice) {
    const Hit hit = anywhere(tracer.scene(), dice);
    LinearSky sky;
    const double bright = dice.magnitude(1e-6, 1e6);
    sky.mean = bright * glm::dvec3(1.0, dice.unit(), dice.unit());
    for (int axis = 0; axis < 3; ++axis) sky.gradient[axis] = bright * 0.3 * dice.inCube();
    std::int64_t traced = 0;
    const auto rays = castAmbientRays(tracer, hit, hit.geometricNormal, {}, 7, traced);
    const AmbientValue value = averageOf(rays);
    glm::dvec3 sum(0.0);
    for (const AmbientDirection& ray : rays)
        sum += ray.open * (sky.mean + sky.gradient * ray.direction) * std::numbers::pi / double(rays.size());
    const glm::dvec3 light = sky.irradiance(value.visibility, value.bent);
    verdict.expectAtMost("light of a linear sky, negative", -std::min({light.x, light.y, light.z}), 0.0);
    verdict.expectAtMost("light of a linear sky, relative difference from the sum over its rays",
                         glm::length(light - glm::max(sum, glm::dvec3(0.0))) / bright, 1e-13);
}

/// From inside of a closed body nothing is seen: no direction, so the normal itself, and weight 0.
void nothing(Verdict& verdict, const Case& given, Dice& dice) {
    const Scene body = closedBody(given, 0.01, dice);
    const std::vector<Triangle> triangles = trianglesIn(body);
    Hit hit = surfaceHit(body, std::uint32_t(dice.below(int(triangles.size()))), {0.3, 0.4});
    hit.geometricNormal = -hit.geometricNormal;
    // In a body so flat that the rays' lift is beyond it, something is seen.
    if (windingNumber(triangles, hit.position + 64.0 * floatUlp(body) * hit.geometricNormal) < 0.5) return;
    std::int64_t traced = 0;
    const AmbientValue value = estimateAmbient(RayTracer(body), hit, hit.geometricNormal, {}, 3, traced);
    verdict.expectAtMost("sky seen from inside of a closed body", value.visibility, 0.0);
    verdict.expectAtMost("bent normal there, off the normal",
                         glm::distance(bentNormal(value, hit.geometricNormal), hit.geometricNormal), 0.0);
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(std::uint64_t(given.integer("variant")));
    std::vector<Triangle> triangles;
    const glm::dvec3 where = given.number("distance") / std::sqrt(3.0) * glm::dvec3(1.0);
    for (int i = 0; i < 4; ++i)
        for (Triangle t :
             trianglesOf(given.choice("shape"), {0.5 * dice.inCube(), dice.magnitude(0.1, 1.0)}, dice)) {
            for (glm::dvec3& p : t) p = given.number("scale") * p + where;
            triangles.push_back(t);
        }
    const Scene scene = sceneOf(triangles);
    const RayTracer tracer(scene);
    for (int i = 0; i < 4; ++i) {
        seen(verdict, given, tracer, dice);
        linearSky(verdict, tracer, dice);
    }
    nothing(verdict, given, dice);
    return verdict;
}

const AddSubject bentNormals(
    {.name = "bent-normal",
     .claim = "what exact rays see is in [0,1], bent vectors are as short as it wants and "
              "never without a direction, and linear skies are lit exactly",
     .axes = {"shape", "scale", "distance", "samples", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
