// Exact shadows in scenes: the hierarchy must change nothing, let nothing through, and never shadow a surface
// by itself.
#include "common/truth/exact_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "common/truth/polygon_light.h"

namespace penumbra {
namespace {

using glm::dvec3;

/// A scene of nothing but triangles: each inner list becomes a part.
Scene makeScene(const std::vector<std::vector<Triangle>>& parts) {
    Scene scene;
    for (const std::vector<Triangle>& triangles : parts) {
        Part part;
        part.firstTriangle = std::uint32_t(scene.triangleCount());
        part.triangleCount = std::uint32_t(triangles.size());
        for (const Triangle& t : triangles)
            for (const dvec3& p : t) {
                scene.indices.push_back(std::uint32_t(scene.positions.size()));
                scene.positions.push_back(glm::vec3(p));
            }
        scene.parts.push_back(part);
    }
    return scene;
}

/// The floats of the scene, which are what it is.
std::vector<Triangle> trianglesOf(const Scene& scene) {
    std::vector<Triangle> triangles(scene.triangleCount());
    for (std::size_t i = 0; i < scene.indices.size(); ++i)
        triangles[i / 3][i % 3] = dvec3(scene.positions[scene.indices[i]]);
    return triangles;
}

std::vector<Triangle> quad(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
    return {{a, b, c}, {a, c, d}};
}

std::vector<Triangle> soup(std::size_t count, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Triangle> triangles(count);
    for (Triangle& t : triangles) {
        const dvec3 centre(uniform(random), uniform(random), 1.0 + uniform(random));
        for (dvec3& p : t) p = centre + size * dvec3(uniform(random), uniform(random), uniform(random));
    }
    return triangles;
}

/// Sphere of triangles, outwards counter-clockwise.
std::vector<Triangle> sphere(const dvec3& centre, double radius, int rings) {
    const auto at = [&](int i, int j) {
        const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * (j % (2 * rings)) / rings;
        const double s = i == 0 || i == rings ? 0.0 : std::sin(theta);
        return centre + radius * dvec3(s * std::cos(phi), s * std::sin(phi), std::cos(theta));
    };
    std::vector<Triangle> triangles;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < 2 * rings; ++j) {
            if (i > 0) triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (i + 1 < rings) triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    return triangles;
}

// Heckbert & Herf 1997, figure 2.
const std::vector<dvec3> light = {{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}};
const dvec3 up(0, 0, 1);
const PlanarReceiver receiver = {{-1.2, -1.2, 0}, {2.4, 0, 0}, {0, 2.4, 0}};

Scene heckbertHerf() {
    return makeScene({quad({-1.2, -1.2, 0}, {1.2, -1.2, 0}, {1.2, 1.2, 0}, {-1.2, 1.2, 0}),
                      {{dvec3(-0.4, -0.35, 1), dvec3(0.45, -0.3, 1), dvec3(0, 0.45, 1)}},
                      quad(light[0], light[1], light[2], light[3])});
}

TEST(ExactScene, ImageOfHeckbertAndHerf) {
    const Scene scene = heckbertHerf();
    const ExactScene exact(scene);
    const glm::ivec2 size(256, 192);
    const std::vector<double> image = exact.formFactorImage(receiver, size, light, 2);
    ASSERT_EQ(image.size(), 256u * 192u);
    const Triangle occluder = trianglesOf(scene)[2];
    double sum = 0.0;
    for (int row = 0; row < size.y; ++row)
        for (int column = 0; column < size.x; ++column) {
            const double value = image[std::size_t(row) * std::size_t(size.x) + std::size_t(column)];
            const dvec3 x(-1.2 + 2.4 * (column + 0.5) / size.x, -1.2 + 2.4 * (row + 0.5) / size.y, 0);
            EXPECT_NEAR(value, visibleFormFactor(x, up, light, {&occluder, 1}), 1e-14)
                << column << ',' << row;
            sum += value;
        }
    EXPECT_NEAR(sum / double(image.size()), 0.039284125595,
                1e-6);  // the triangle rounded to float, another grid
    // The light's own two triangles and the receiver shadow nothing, ignored or not.
    EXPECT_EQ(image, exact.formFactorImage(receiver, size, light));
}

TEST(ExactScene, TheHierarchyChangesNoBit) {
    const Scene scene = makeScene({soup(300, 0.15, 1), soup(200, 0.1, 2)});
    const std::vector<Triangle> all = trianglesOf(scene);
    const std::vector<Triangle> firstPart(all.begin(), all.begin() + 300);
    const ExactScene exact(scene);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int partial = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const dvec3 x(uniform(random), uniform(random), -0.1 + 0.2 * uniform(random));
        const dvec3 n = glm::normalize(dvec3(uniform(random), uniform(random), 1.5));
        const double value = exact.visibleFormFactor(x, n, light);
        EXPECT_EQ(value, visibleFormFactor(x, n, light, all));
        EXPECT_EQ(exact.visibleFormFactor(x, n, light, 1), visibleFormFactor(x, n, light, firstPart));
        partial += value > 0.0 && value < formFactor(x, n, light) ? 1 : 0;
    }
    EXPECT_GT(partial, 200);
}

TEST(ExactScene, OccludedAgreesWithEveryTriangleTried) {
    const Scene scene = makeScene({soup(150, 0.2, 4), soup(50, 0.2, 5)});
    const std::vector<Triangle> all = trianglesOf(scene);
    const ExactScene exact(scene);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int hits = 0, wrong = 0;
    for (int trial = 0; trial < 30000; ++trial) {
        const dvec3 x = dvec3(uniform(random), uniform(random), 1.0 + uniform(random));
        dvec3 target = dvec3(uniform(random), uniform(random), 1.0 + uniform(random));
        if (trial % 5 == 0) target.x = x.x;  // parallel to a side of every box
        if (trial % 10 == 0) target.y = x.y;
        bool blocked = false;  // Moeller & Trumbore, JGT 1997
        for (std::size_t i = 0; i < (trial % 2 == 0 ? 200u : 150u); ++i) {
            const Triangle& t = all[i];
            const dvec3 d = target - x, e1 = t[1] - t[0], e2 = t[2] - t[0], p = glm::cross(d, e2),
                        s = x - t[0];
            const dvec3 q = glm::cross(s, e1);
            const double det = glm::dot(p, e1);
            const double a = glm::dot(s, p) / det, b = glm::dot(d, q) / det, along = glm::dot(e2, q) / det;
            blocked = blocked || (a >= 0.0 && b >= 0.0 && a + b <= 1.0 && along > 0.0 && along < 1.0);
        }
        hits += blocked ? 1 : 0;
        wrong += exact.occluded(x, noTriangle, target, trial % 2 == 0 ? noPart : 1) != blocked ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(hits, 5000);
    EXPECT_LT(hits, 25000);
}

TEST(ExactScene, NothingGetsThroughACloseMesh) {
    const Scene scene = makeScene({sphere({0.1, -0.2, 0.3}, 1.0, 24)});
    const ExactScene exact(scene);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const dvec3 x(0.15, -0.1, 0.2);
    int leaks = 0;
    for (const Triangle& t : trianglesOf(scene))
        for (std::size_t i = 0; i < 3; ++i) {
            // Through the very vertices, through points of edges, and through the middle.
            for (const dvec3& through :
                 {t[i], glm::mix(t[i], t[(i + 1) % 3], uniform(random)), (t[0] + t[1] + t[2]) / 3.0}) {
                leaks += exact.occluded(x, noTriangle, x + 3.0 * (through - x)) ? 0 : 1;
                leaks += exact.occluded(x + 3.0 * (through - x), noTriangle, x) ? 0 : 1;
            }
        }
    EXPECT_EQ(leaks, 0);
    // The same for the light: cones of neighbours leave no crack. Seen from inside, all of it is dark.
    for (int trial = 0; trial < 20; ++trial) {
        const dvec3 inside(0.1 + 0.3 * uniform(random), -0.2 * uniform(random), 0.3 * uniform(random));
        EXPECT_LE(exact.visibleFormFactor(inside, up, light), 1e-15);
    }
}

TEST(ExactScene, ASurfaceDoesNotShadowItself) {
    // From a point computed on each triangle of a sphere: free towards anything above it, and the exact
    // irradiance is that of the light above the horizon.
    const Scene scene = makeScene({sphere({0, 0, 0}, 0.7, 16)});
    const ExactScene exact(scene);
    const std::vector<Triangle> all = trianglesOf(scene);
    int lit = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Triangle& t = all[i];
        const dvec3 n = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
        for (const dvec3& weights : {dvec3(0.2, 0.5, 0.3), dvec3(1e-9, 0.5, 0.5 - 1e-9), dvec3(1.0 / 3.0)}) {
            const dvec3 x = weights.x * t[0] + weights.y * t[1] + weights.z * t[2];
            EXPECT_FALSE(exact.occluded(x, std::uint32_t(i), x + n + 0.4 * (t[0] - x))) << "triangle " << i;
            const double value = exact.visibleFormFactor(x, n, light, noPart, std::uint32_t(i));
            EXPECT_NEAR(value, formFactor(x, n, light), 1e-14)
                << "triangle " << i;  // a convex body shadows only below
            lit += value > 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 300);
}

TEST(ExactScene, AWallOnTheGroundLeaksNothing) {
    // The wall x = 0 stands on the ground with no gap. Right behind its foot the light in front of it is
    // invisible.
    const auto ground = quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0});
    const auto wall = quad({0, -4, 0}, {0, 4, 0}, {0, 4, 5}, {0, -4, 5});
    const ExactScene exact(makeScene({ground, wall}));
    const std::vector<dvec3> side = {{2, -0.5, 1}, {2, -0.5, 2}, {2, 0.5, 2}, {2, 0.5, 1}};  // faces -x
    for (const double d : {1e-13, 1e-9, 1e-6, 0.1, 1.0}) {  // below 1e-14 a double cannot tell the side
        EXPECT_LE(exact.visibleFormFactor({-d, 0.1, 0}, up, side), 1e-15) << "behind the wall by " << d;
        EXPECT_EQ(exact.visibleFormFactor({d, 0.1, 0}, up, side), formFactor({d, 0.1, 0}, up, side));
        EXPECT_TRUE(exact.occluded({-d, 0.1, 0}, 0, {2, 0.3, 1.5}));
        EXPECT_FALSE(exact.occluded({d, 0.1, 0}, 0, {2, 0.3, 1.5}));
    }
}

TEST(ExactScene, SegmentEndsDoNotCount) {
    const ExactScene exact(makeScene({quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})}));
    EXPECT_TRUE(exact.occluded({0.2, 0.1, -1}, noTriangle, {0.2, 0.1, 1}));
    EXPECT_FALSE(exact.occluded({0.2, 0.1, -1}, noTriangle, {0.2, 0.1, 0}));  // ends on the quad
    EXPECT_FALSE(exact.occluded({0.2, 0.1, 0}, noTriangle, {0.2, 0.1, 1}));   // starts on it
    EXPECT_FALSE(exact.occluded({0.2, 0.1, -1}, noTriangle, {0.2, 0.1, -0.1}));
    EXPECT_FALSE(exact.occluded({-3, 0.1, 0}, noTriangle, {3, 0.1, 0}));  // in its plane
    EXPECT_FALSE(exact.occluded({2, 0.1, -1}, noTriangle, {2, 0.1, 1}));
}

TEST(ExactScene, ATriangleWithoutAreaShadowsNothing) {
    // Three floats in a line; segments that go right through it.
    const Triangle line = {
        dvec3(58.3125, -171.875, -60.125), {8.3125, -127.875, 26.25}, {33.3125, -149.875, -16.9375}};
    const ExactScene exact(makeScene({{line}}));
    std::mt19937 random(21);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int trial = 0; trial < 2000; ++trial) {
        const dvec3 x(300.0 * uniform(random), 300.0 * uniform(random), 300.0 * uniform(random));
        const dvec3 on = line[0] + (0.5 + 0.5 * uniform(random)) * (line[1] - line[0]);
        EXPECT_FALSE(exact.occluded(x, noTriangle, on + 0.5 * (on - x)));
        EXPECT_FALSE(exact.occluded(x, noTriangle, line[2] + 1e-9 * (line[2] - x)));
    }
}

TEST(ExactScene, AnEmptySceneShadowsNothing) {
    const ExactScene exact((Scene()));
    EXPECT_FALSE(exact.occluded({0, 0, 0}, noTriangle, {0, 0, 5}));
    EXPECT_EQ(exact.visibleFormFactor({0, 0, 0}, up, light), formFactor({0, 0, 0}, up, light));
}

}  // namespace
}  // namespace penumbra
