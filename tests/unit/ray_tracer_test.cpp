// The reference ray tracer against closed forms: where rays hit, that surfaces never shadow themselves, that
// nothing leaks in where surfaces touch, and that float and double agree about who shadows whom.
#include "common/truth/ray_tracer.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "common/truth/exact_scene.h"
#include "common/truth/segment_test.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {
namespace {

using namespace test_meshes;

struct Placement {
    double scale, offset;
};
const std::vector<Placement> placements = {{1, 0},    {1e-3, 0},  {1e3, 0}, {1, 1e4},
                                           {1e-3, 1}, {1e3, 1e4}, {1, -1e3}};

TEST(Nearest, MeetsThePlaneWhereTheExactRayDoes) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (const auto [scale, offset] : placements) {
        Scene scene = emptyScene();
        const Place place = scaledAndMoved(scale, offset);
        addQuad(scene, {-9, -3, 9}, {9, -3, 9}, {9, 3, -9}, {-9, 3, -9}, place);
        const RayTracer tracer(scene);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 origin = place(glm::dvec3(uniform(random), 6.0, uniform(random)));
            const Ray ray{origin, scale * glm::dvec3(uniform(random), -5.0, uniform(random))};
            const Hit hit = tracer.nearest(ray);
            ASSERT_TRUE(hit.valid);
            const std::uint32_t* t = &scene.indices[3 * hit.triangle];
            const glm::dvec3 a(scene.positions[t[0]]);
            const glm::dvec3 n = faceNormal(scene, hit.triangle);
            const double along = glm::dot(n, a - origin) / glm::dot(n, ray.direction);
            const glm::dvec3 exact = origin + along * ray.direction;
            // Double arithmetic on coordinates of this size; float would be off by a hundred million times
            // more.
            EXPECT_LE(glm::length(hit.position - exact), 64.0 * 0x1p-53 * (std::abs(offset) + 20.0 * scale));
        }
    }
}

TEST(Nearest, MeetsTheSphereBetweenChordAndArc) {
    Scene scene = emptyScene();
    addSphere(scene, 5, scaledAndMoved(1.0, 0.0));
    const RayTracer tracer(scene);
    // Facets of a sphere of edge e lie at most e^2/6 (circumradius e/sqrt 3, sagitta half its square) beneath
    // it.
    double longest = 0.0;
    for (std::size_t i = 0; i < scene.indices.size(); i += 3)
        longest = std::max(longest, glm::length(glm::dvec3(scene.positions[scene.indices[i]]) -
                                                glm::dvec3(scene.positions[scene.indices[i + 1]])));
    const double sagitta = longest * longest / 6.0 * 1.01;
    std::mt19937_64 random(2);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 from = 4.0 * randomDirection(random), to = 0.5 * randomDirection(random);
        const glm::dvec3 d = glm::normalize(to - from);
        const Hit hit = tracer.nearest({from, d});
        ASSERT_TRUE(hit.valid);
        const double radius = glm::length(hit.position);
        EXPECT_LE(radius, 1.0 + 1e-7);
        EXPECT_GE(radius, 1.0 - sagitta);
        EXPECT_LE(glm::length(glm::cross(d, hit.position - from)),
                  1e-6);  // on the ray, unless forced to an edge
        EXPECT_LT(glm::dot(hit.geometricNormal, d), 0.0);
    }
    EXPECT_FALSE(tracer.nearest({{0, 0, 4}, {0, 1, 0}}).valid);
}

/// How far from its ray a hit lies, metres.
double offItsRay(const Hit& hit, const Ray& ray) {
    return glm::length(glm::cross(hit.position - ray.origin, glm::normalize(ray.direction)));
}

TEST(Nearest, LiesOnItsRayHoweverSmallTheTriangle) {
    std::mt19937_64 random(41);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Scene scene = emptyScene();
    addPart(scene, {{0.3, 0.4, 0.5}, {0.301, 0.4, 0.5}, {0.3, 0.401, 0.5003}}, {0, 1, 2},
            scaledAndMoved(1.0, 0.0));
    const RayTracer tracer(scene);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 eye =
            100.0 * glm::dvec3(uniform(random), uniform(random), 1.5 + 0.5 * uniform(random));
        const Ray ray{eye, pointOn(scene, 0, 0.2 + 0.1 * uniform(random), 0.2 + 0.1 * uniform(random)) - eye};
        const Hit hit = tracer.nearest(ray);
        ASSERT_TRUE(hit.valid);
        EXPECT_LE(offItsRay(hit, ray), 64.0 * 0x1p-53 * 200.0);  // 1e-11 if edges lost their digits
    }
}

TEST(Nearest, LiesOnItsRayOnATriangleWithoutAreaToo) {
    // Three floats in a line. Embree's barycentric coordinates lead anywhere on it.
    Scene scene = emptyScene();
    addQuad(scene, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9});
    for (const int corner : {1, 2}) scene.indices[std::size_t(corner)] = std::uint32_t(corner == 1 ? 4 : 5);
    for (const glm::vec3& p : {glm::vec3(2.25f, 15.25f, -5.0f), glm::vec3(5.25f, 15.75f, -6.5f)}) {
        scene.positions.push_back(p);
        scene.normals.emplace_back(0.0f, 1.0f, 0.0f);
        scene.uvs.emplace_back(0.0f);
    }
    scene.positions[0] = {3.75f, 15.5f, -5.75f};
    const RayTracer tracer(scene);
    std::mt19937_64 random(42);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 eye(40.0 * uniform(random), 60.0 + 20.0 * uniform(random), 40.0 * uniform(random));
        const Ray ray{eye, glm::dvec3(scene.positions[4]) +
                               (0.5 + 0.5 * uniform(random)) * glm::dvec3(3.0, 0.5, -1.5) - eye};
        const Hit hit = tracer.nearest(ray);
        if (!hit.valid || hit.triangle != 0) continue;
        ++hits;
        EXPECT_LE(offItsRay(hit, ray), 64.0 * 0x1p-23 * 80.0);
    }
    EXPECT_GT(hits, 0) << "no ray met it: the case tests nothing";
}

TEST(CrossTriangle, IsSureOfTheEdgesOfASmallTriangleFarAway) {
    std::mt19937_64 random(43);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const glm::dvec3 far(0.57, -0.31, 0.376);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 u = randomDirection(random),
                         w = glm::normalize(glm::cross(u, randomDirection(random)));
        const glm::dvec3 v = glm::cross(w, u);
        if (std::abs(glm::dot(w, far)) < 0.1) continue;
        const std::array<glm::dvec3, 3> t = {far, far + 1e-6 * u, far + 1e-6 * v};
        const glm::dvec3 onEdge = far + (0.5 + 0.4 * uniform(random)) * 1e-6 * u;
        EXPECT_EQ(crossTriangle({glm::dvec3(0.0), onEdge + 1e-13 * v, true}, t), Crossing::inside);
        EXPECT_EQ(crossTriangle({glm::dvec3(0.0), onEdge - 1e-13 * v, true}, t), Crossing::missed);
    }
}

TEST(Nearest, LeavesOutTheIgnoredPart) {
    Scene scene = emptyScene();
    addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    addQuad(scene, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1});
    const RayTracer tracer(scene);
    const Ray down{{0.1, 3, 0.2}, {0, -1, 0}};
    EXPECT_EQ(tracer.nearest(down).part, 0u);
    EXPECT_EQ(tracer.nearest(down, 0).part, 1u);
    const Hit below = tracer.nearest(down, 0);
    EXPECT_TRUE(tracer.occluded(below, down.origin));
    EXPECT_FALSE(tracer.occluded(below, down.origin, 0));
}

/// One float ulp of the largest coordinate: what the float ray of a shadow ray is good to.
double ulpOf(const Scene& scene) {
    double largest = 0.0;
    for (int i = 0; i < 3; ++i)
        largest = std::max({largest, std::abs(scene.bounds.lower[i]), std::abs(scene.bounds.upper[i])});
    return 0x1p-23 * largest;
}

/// Rays from random points of a convex mesh to the outside of their own face: nothing can be in the way.
std::size_t falseHits(const Scene& scene, std::size_t count, std::uint64_t seed) {
    const RayTracer tracer(scene);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double size = scene.bounds.radius();
    std::vector<ShadowRay> rays(count);
    for (ShadowRay& ray : rays) {
        ray.triangle = std::uint32_t(random() % scene.triangleCount());
        // A third near an edge, down to 1e-8, where the neighbouring triangle is less than a float ulp away.
        const double u = random() % 3 == 0 ? std::exp(-18.0 * uniform(random)) : uniform(random);
        ray.origin = pointOn(scene, ray.triangle, u, uniform(random) * (1.0 - u));
        const glm::dvec3 n = ray.normal = faceNormal(scene, ray.triangle);
        ray.edgeDistance = edgeDistance(scene, ray.triangle, ray.origin);
        glm::dvec3 d = randomDirection(random);
        if (glm::dot(d, n) < 0.0) d = -d;
        if (random() % 4 == 0) d = glm::normalize(d + (1e-5 - glm::dot(d, n)) * n);  // grazing
        ray.towardsInfinity = random() % 2 == 0;
        ray.target = ray.towardsInfinity ? d : ray.origin + d * size * uniform(random) * 4.0;
    }
    std::vector<std::uint8_t> blocked(count);
    tracer.occluded(rays, blocked);
    return std::size_t(std::count(blocked.begin(), blocked.end(), 1));
}

TEST(Occluded, ConvexSurfacesNeverShadowThemselves) {
    for (const auto [scale, offset] : placements) {
        Scene box = emptyScene();
        addBox(box, scaledAndMoved(scale, offset));
        EXPECT_EQ(falseHits(box, 200000, 3), 0u) << "box, scale " << scale << ", offset " << offset;
    }
    for (const double scale : {1e-3, 1.0, 1e3}) {
        Scene sphere = emptyScene();
        addSphere(sphere, 4, scaledAndMoved(scale, 0.0));
        EXPECT_EQ(falseHits(sphere, 200000, 4), 0u) << "sphere, scale " << scale;
    }
}

/// The answer that ExactScene gives, for rays from random points to random places around.
struct Disagreement {
    std::size_t shadowed = 0;     ///< rays that are blocked
    std::size_t tooDark = 0;      ///< blocked by the ray tracer only
    std::size_t tooBright = 0;    ///< blocked by the exact answer only ...
    std::size_t unexplained = 0;  ///< ... and still blocked wherever an end is moved by up to 32 ulps
};
Disagreement compareWithExact(const Scene& scene, std::size_t count, std::uint64_t seed) {
    const RayTracer tracer(scene);
    const ExactScene exact(scene);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<ShadowRay> rays(count);
    for (ShadowRay& ray : rays) {
        ray.triangle = std::uint32_t(random() % scene.triangleCount());
        ray.origin = pointOn(scene, ray.triangle, uniform(random), uniform(random));
        ray.normal = faceNormal(scene, ray.triangle);
        ray.edgeDistance = edgeDistance(scene, ray.triangle, ray.origin);
        const glm::dvec3 d = randomDirection(random);
        if (glm::dot(d, ray.normal) < 0.0) ray.normal = -ray.normal;
        ray.target = ray.origin + d * 2.0 * scene.bounds.radius() * uniform(random);
    }
    std::vector<std::uint8_t> blocked(count);
    tracer.occluded(rays, blocked);
    Disagreement result;
    for (std::size_t i = 0; i < count; ++i) {
        const ShadowRay& ray = rays[i];
        const bool truth = exact.occluded(ray.origin, ray.triangle, ray.target);
        result.shadowed += truth;
        result.tooDark += !truth && blocked[i];
        if (!truth || blocked[i]) continue;
        ++result.tooBright;
        bool explained = false;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double ulps : {-32.0, -16.0, -8.0, 8.0, 16.0, 32.0}) {
                glm::dvec3 moved(0.0);
                moved[axis] = ulps * ulpOf(scene);
                const bool sameSide = glm::dot(moved, ray.normal) >= 0.0;
                explained = explained || !exact.occluded(ray.origin, ray.triangle, ray.target + moved) ||
                            (sameSide && !exact.occluded(ray.origin + moved, ray.triangle, ray.target));
            }
        }
        result.unexplained += !explained;
    }
    return result;
}

TEST(Occluded, AgreesWithDoublePrecisionOnTerrain) {
    for (const auto [scale, offset] : placements) {
        Scene scene = emptyScene();
        addTerrain(scene, 24, 0.2, scaledAndMoved(scale, offset));
        const Disagreement d = compareWithExact(scene, 200000, 5);
        SCOPED_TRACE("scale " + std::to_string(scale) + ", offset " + std::to_string(offset));
        EXPECT_GT(d.shadowed, 20000u);
        EXPECT_EQ(d.tooDark, 0u);
        EXPECT_EQ(d.unexplained, 0u);
    }
}

/// A ground with a wall standing on it, no gap: points of the ground ever closer to the wall, a light behind
/// the wall.
std::size_t leaksAtContact(const Place& place, std::size_t count, std::uint64_t seed) {
    Scene scene = emptyScene();
    addQuad(scene, {-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}, place);
    addQuad(scene, {-4, 0, 0}, {4, 0, 0}, {4, 2, 0}, {-4, 2, 0}, place);
    const RayTracer tracer(scene);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::size_t leaks = 0;
    for (std::size_t i = 0; i < count; ++i) {
        // In the wall's own coordinates, so that "in front of it" is exact however the place rounds.
        const glm::dvec3 a(scene.positions[4]), along = glm::dvec3(scene.positions[5]) - a;
        const glm::dvec3 up = glm::dvec3(scene.positions[7]) - a;
        const glm::dvec3 out = glm::normalize(glm::cross(along, up));
        const double gap = glm::length(up) * std::exp2(-1.0 - 24.0 * uniform(random));
        Hit from;
        from.position = a + (0.25 + 0.5 * uniform(random)) * along + gap * out;
        from.triangle = 0;
        from.geometricNormal = faceNormal(scene, 0);
        from.edgeDistance = edgeDistance(scene, 0, from.position);
        const glm::dvec3 target = from.position - out * (gap + glm::length(up) * (0.05 + uniform(random))) +
                                  up * (0.02 + 0.9 * uniform(random)) + along * (0.2 * uniform(random) - 0.1);
        // Only where the segment passes below the top of the wall.
        const double t = gap / glm::dot(from.position - target, out);
        const double height =
            glm::dot(from.position + t * (target - from.position) - a, up) / glm::dot(up, up);
        if (height <= 0.0 || height >= 1.0 - 32.0 * ulpOf(scene) / glm::length(up)) continue;
        leaks += !tracer.occluded(from, target);
    }
    return leaks;
}

TEST(Occluded, NothingLeaksInWhereAWallStandsOnTheGround) {
    for (const auto [scale, offset] : placements)
        EXPECT_EQ(leaksAtContact(scaledAndMoved(scale, offset), 50000, 6), 0u)
            << "scale " << scale << ", offset " << offset;
}

/// A valley of two walls at 20 degrees: points of one wall ever closer to the fold, behind which the lifted
/// float ray would begin beyond the other wall; the light is behind that one.
TEST(Occluded, NothingLeaksInAtTheFoldOfAValley) {
    for (const auto [scale, offset] : placements) {
        Scene scene = emptyScene();
        const Place place = scaledAndMoved(scale, offset);
        const double rise = std::tan(std::numbers::pi / 9.0);
        addPart(scene, {{0, 0, 2}, {4, 0, 2}, {4, 0, -2}, {0, 0, -2}, {4, 4 * rise, 2}, {4, 4 * rise, -2}},
                {0, 1, 2, 0, 2, 3, 0, 4, 5, 0, 5, 3}, place);
        const RayTracer tracer(scene);
        std::mt19937_64 random(8);
        std::uniform_real_distribution<double> uniform(0.0, 1.0);
        const double ulp = ulpOf(scene);
        std::size_t leaks = 0;
        for (int i = 0; i < 20000; ++i) {
            const glm::dvec3 fold(scene.positions[0]);
            Hit from;
            from.triangle = 1;
            from.geometricNormal = faceNormal(scene, 1);
            from.position = pointOn(scene, 1, 0.25 + 0.25 * uniform(random), 0.25 + 0.25 * uniform(random));
            from.position.x = fold.x + ulp * std::exp2(8.0 * uniform(random) - 1.0);
            from.position.y = fold.y;
            from.edgeDistance = edgeDistance(scene, 1, from.position);
            leaks += !tracer.occluded(from, from.position + scale * glm::dvec3(0.1 * uniform(random), 1, 0));
        }
        EXPECT_EQ(leaks, 0u) << "scale " << scale << ", offset " << offset;
    }
}

/// An origin that a caller rounded a little behind its own surface.
TEST(Occluded, ItsOwnTriangleNeverBlocks) {
    Scene scene = emptyScene();
    addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    const RayTracer tracer(scene);
    Hit from = tracer.nearest({{0.3, 0.5, 0.2}, {0, -1, 0}});
    from.position.y = -0.01;
    EXPECT_FALSE(tracer.occluded(from, {0.3, 1.0, 0.2}));
    from.triangle = ShadowRay::noTriangle;
    EXPECT_TRUE(tracer.occluded(from, {0.3, 1.0, 0.2}));
}

TEST(Occluded, BatchAndSingleRaysAgree) {
    Scene scene = emptyScene();
    addTerrain(scene, 24, 0.2, scaledAndMoved(1.0, 0.0));
    const RayTracer tracer(scene);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<ShadowRay> rays(1003);
    for (ShadowRay& ray : rays) {
        ray.triangle = std::uint32_t(random() % scene.triangleCount());
        ray.origin = pointOn(scene, ray.triangle, uniform(random), uniform(random));
        ray.normal = faceNormal(scene, ray.triangle);
        ray.edgeDistance = edgeDistance(scene, ray.triangle, ray.origin);
        ray.target = randomDirection(random);
        ray.towardsInfinity = random() % 2 == 0;
    }
    std::vector<std::uint8_t> blocked(rays.size());
    tracer.occluded(rays, blocked);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Hit from;
        from.position = rays[i].origin;
        from.triangle = rays[i].triangle;
        from.geometricNormal = rays[i].normal;
        from.edgeDistance = rays[i].edgeDistance;
        const bool single = rays[i].towardsInfinity ? tracer.occludedTowards(from, rays[i].target)
                                                    : tracer.occluded(from, rays[i].target);
        EXPECT_EQ(blocked[i] != 0, single);
    }
}

TEST(Occluded, TouchingIsNotShadowing) {
    Scene scene = emptyScene();
    addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    addQuad(scene, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1});
    const RayTracer tracer(scene);
    const Hit from = tracer.nearest({{0.3, 0.5, 0.2}, {0, -1, 0}});
    EXPECT_FALSE(tracer.occluded(from, {0.1, 1.0, 0.1}));         // ends in the upper surface
    EXPECT_TRUE(tracer.occluded(from, {0.1, 1.0 + 1e-12, 0.1}));  // ends just beyond it
    EXPECT_FALSE(tracer.occluded(from, from.position));           // of no length
    EXPECT_FALSE(tracer.occludedTowards(from, {1, 0, 0}));        // along the surface
}

}  // namespace
}  // namespace penumbra
