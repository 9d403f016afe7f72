// Ambient visibility and bent vectors by rays: baked at vertices and triangles, from bits, and at a hit.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/09_ambient_occlusion/visibility_bits.h"
#include "tests/stress/bent_bound.h"
#include "tests/stress/closed_body.h"
#include "tests/stress/triangle_shapes.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

/// Ground, and adversarial triangles above it and in it.
Scene clutter(const Case& given, Dice& dice) {
    std::vector<Triangle> triangles;
    const auto quad = [&](const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
        triangles.push_back({corner, corner + u, corner + u + v});
        triangles.push_back({corner, corner + u + v, corner + v});
    };
    for (int i = 0; i < 4; ++i) quad({-1.0 + 0.5 * i, 0.0, 1.0}, {0.5, 0.0, 0.0}, {0.0, 0.0, -2.0});
    quad({-0.7, 0.0, 0.2}, {1.2, 0.0, 0.3}, {0.0, 0.8, 0.0});  // a wall that stands on it
    for (int i = 0; i < 2; ++i) {
        const TrianglePlace place{
            glm::dvec3(0.0, 0.3, 0.0) + 0.4 * dice.inCube(), dice.magnitude(0.1, 0.6), {0.0, 1.0, 0.0}};
        for (const Triangle& t : trianglesOf(given.choice("shape"), place, dice)) triangles.push_back(t);
    }
    const glm::dvec3 where = given.number("distance") / std::sqrt(3.0) * glm::dvec3(1.0);
    for (Triangle& t : triangles)
        for (glm::dvec3& p : t) p = given.number("scale") * p + where;
    return sceneOf(triangles);
}

/// Finite, between nothing and all, and a bent vector that such a visibility can have.
void inRange(Verdict& verdict, const std::string& name, const std::vector<AmbientValue>& values,
             const BakeSettings& settings) {
    double below = 0.0, above = 0.0, bent = 0.0, broken = 0.0;
    for (const AmbientValue& v : values) {
        below = std::max(below, -v.visibility);
        above = std::max(above, v.visibility - 1.0);
        bent = std::max(bent, glm::length(v.bent) - longestBent(v.visibility, settings.rays.weighting));
        if (!std::isfinite(v.visibility) || !std::isfinite(glm::length(v.bent))) broken = 1.0;
    }
    verdict.expectAtMost(name + ": visibility below 0", below, 0.0);
    // One over the mean of many ones.
    verdict.expectAtMost(name + ": visibility above 1", above,
                         settings.rays.weighting == Weighting::cosine ? 0.0 : 1e-6);
    verdict.expectAtMost(name + ": not a number", broken, 0.0);
    // Where neighbours help, the vector and the visibility are of different weights.
    verdict.expectAtMost(name + ": bent vector longer than its visibility allows, over the rays' discrepancy",
                         bent / discrepancy(settings.rays.count), 1.0);
}

double largestDifference(const std::vector<AmbientValue>& a, const std::vector<AmbientValue>& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(
            {largest, std::abs(a[i].visibility - b[i].visibility), glm::distance(a[i].bent, b[i].bent)});
    return largest;
}

/// Every point of a convex body sees all of the sky, to the last bit.
void convex(Verdict& verdict, const Case& given, BakeSettings settings, Dice& dice) {
    constexpr double flattest = 1e-4;
    const Scene body = closedBody(given, flattest, dice);
    const RayBundle bundle(body);
    settings.skip = dice.oneIn(2);
    double least = 1.0;
    for (const AmbientBake& bake :
         {bakeVertices(body, bundle, settings), bakeTriangles(body, bundle, settings)})
        for (const AmbientValue& v : bake.values) least = std::min(least, v.visibility);
    const double ulps = body.bounds.radius() / floatUlp(body);
    // Thinner than what counts as touching (tangentTolerance), its sides are rounding and nothing else.
    if (ulps * flattest > 8.0) verdict.expectAtMost("a convex body is dark by", 1.0 - least, 0.0);
}

void bits(Verdict& verdict, const Scene& scene, const RayBundle& bundle, const BakeSettings& settings) {
    const BakedBits baked = bakeBits(scene, bundle, 64, settings.rays.reach);
    const std::vector<glm::vec3> radiance(64, glm::vec3(1.0f));
    const std::vector<glm::vec3> light = relight(baked.bits, scene.normals, radiance);
    VisibilityBits all = baked.bits;
    std::fill(all.words.begin(), all.words.end(), ~std::uint64_t(0));
    const std::vector<glm::vec3> unshadowed = relight(all, scene.normals, radiance);
    double negative = 0.0, created = 0.0, wrong = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        double sum = 0.0;
        for (std::size_t l = 0; l < 64; ++l)
            if (baked.bits.open(i, l))
                sum += std::max(0.0,
                                glm::dot(glm::dvec3(scene.normals[i]), glm::dvec3(baked.bits.directions[l])));
        sum *= 4.0 * std::numbers::pi / 64.0;
        negative = std::max(negative, -double(light[i].x));
        created = std::max(created, double(light[i].x) - double(unshadowed[i].x));
        wrong = std::max(wrong, std::abs(double(light[i].x) - sum) / std::numbers::pi);
    }
    verdict.expectAtMost("bits: negative light", negative, 0.0);
    verdict.expectAtMost("bits: more light than without shadows", created, 0.0);
    verdict.expectAtMost("bits: relit otherwise than summed, relative", wrong, 64.0 * 0x1p-24);
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(std::uint64_t(given.integer("variant")));
    BakeSettings settings;
    settings.rays.count = std::max(16, given.integer("samples"));
    settings.rays.weighting = dice.oneIn(2) ? Weighting::cosine : Weighting::uniform;
    if (dice.oneIn(3)) settings.rays.reach.range = given.number("scale") * dice.magnitude(0.01, 10.0);
    settings.rays.reach.smooth = std::isfinite(settings.rays.reach.range) && dice.oneIn(2);
    const Scene scene = clutter(given, dice);
    const RayBundle bundle(scene);
    for (const bool share : {false, true}) {
        settings.share = share;
        const std::string name = share ? "shared rays" : "rays";
        const AmbientBake vertices = bakeVertices(scene, bundle, settings);
        inRange(verdict, name + " at vertices", vertices.values, settings);
        inRange(verdict, name + " at triangles", bakeTriangles(scene, bundle, settings).values, settings);
        BakeSettings all = settings;
        all.skip = false;
        verdict.expectAtMost(name + ": what skipping changes",
                             largestDifference(vertices.values, bakeVertices(scene, bundle, all).values),
                             0.0);
    }
    bits(verdict, scene, bundle, settings);
    convex(verdict, given, settings, dice);
    return verdict;
}

const AddSubject bake(
    {.name = "bake",
     .claim = "baked ambient visibility is in [0,1], and 1 on a convex body; bent vectors are as short as it "
              "wants; a skip changes no bit, and relighting creates no light",
     .axes = {"shape", "scale", "distance", "samples", "variant"},
     .check = check,
     .share = 0.3});

}  // namespace
}  // namespace penumbra::stress
