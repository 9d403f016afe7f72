// --method exact: the closed forms for every texel, the same with and without culling.
#include "chapters/08_accumulation/exact_receiver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "chapters/08_accumulation/unoccluded_texture.h"
#include "common/scene/light.h"
#include "common/truth/exact_scene.h"
#include "common/truth/polygon_light.h"
#include "tests/unit/accumulation_scenes.h"

namespace penumbra {
namespace {

using namespace accumulation_scenes;

constexpr double pi = std::numbers::pi;

double at(const std::vector<double>& values, const Receiver& receiver, int column, int row) {
    return values[std::size_t(row) * std::size_t(receiver.texels.x) + std::size_t(column)];
}

/// One texel whose centre is `x`, on the figure's plane.
double exactAt(const dvec3& x, const Light& light, const std::vector<Triangle>& occluders) {
    const Receiver one = receiverOn(x - dvec3(0.01, 0.01, 0), {0.02, 0, 0}, {0, 0.02, 0}, {1, 1});
    return exactIrradiance(one, light, occluders).values[0] / pi;
}

TEST(AccumulationExact, GoldenValues) {
    for (const auto& g : figure_two::golden) {
        EXPECT_NEAR(exactAt(g.x, squareLight(), {}), g.whole, 5e-15);
        EXPECT_NEAR(exactAt(g.x, squareLight(), {figureTriangle}), g.visible, 5e-15);
    }
}

TEST(AccumulationExact, GoldenMean) {
    const Receiver floor = figureReceiver(512);
    const Triangle t = figureTriangle;
    const ExactIrradiance exact = exactIrradiance(floor, squareLight(), {&t, 1});
    const double sum = std::accumulate(exact.values.begin(), exact.values.end(), 0.0);
    EXPECT_NEAR(sum / (512 * 512 * pi), 0.039284125595, 1e-12);
    EXPECT_LT(exact.shadowTexels, 250000);
    EXPECT_GT(exact.shadowTexels, 200000);
}

TEST(AccumulationExact, CullingChangesNothing) {
    Random random(1);
    std::int64_t tests = 0, culledTests = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const glm::ivec2 texels{5 + random.below(60), 5 + random.below(60)};
        const Receiver receiver = random.receiver(texels);
        const Light light = random.lightNear(receiver);
        std::vector<Triangle> triangles;
        const int count = trial % 10 == 0 ? 60 : random.below(5);
        const Reach reach(receiver, light);
        for (int i = 0; i < count; ++i) {
            const Triangle t = random.triangleNear(receiver, light);
            if (!reach.misses(t)) triangles.push_back(t);  // as Occluders::reaching
        }
        const ExactIrradiance culled = exactIrradiance(receiver, light, triangles);
        const ExactIrradiance all = exactIrradiance(receiver, light, triangles, false);
        for (std::size_t i = 0; i < all.values.size(); ++i)
            ASSERT_EQ(culled.values[i], all.values[i]) << trial;
        tests += all.triangleTests;
        culledTests += culled.triangleTests;
    }
    EXPECT_LT(culledTests, tests / 2);
}

TEST(AccumulationExact, WholeScenesOfOccludersCulledOrNot) {
    // occludersBetween leaves out what can't matter; the closed forms over all triangles agree to the bit.
    Random random(2);
    for (int trial = 0; trial < 100; ++trial) {
        const Receiver receiver = random.receiver({24, 24});
        const Light light = random.lightNear(receiver);
        Scene scene = test_meshes::emptyScene();
        std::vector<Triangle> all;
        for (int i = 0; i < 6; ++i) addTriangles(scene, {random.triangleNear(receiver, light)});
        for (std::size_t i = 0; i < scene.indices.size(); i += 3)
            all.push_back({scene.positions[scene.indices[i]], scene.positions[scene.indices[i + 1]],
                           scene.positions[scene.indices[i + 2]]});
        addClusters(scene);
        const Occluders occluders = occludersBetween(scene, receiver, light);
        const ExactIrradiance some = exactIrradiance(receiver, light, occluders.reaching);
        const ExactIrradiance every = exactIrradiance(receiver, light, all, false);
        EXPECT_EQ(some.values, every.values) << trial;
    }
}

TEST(AccumulationExact, UnoccludedIsLambertsFormulaToTheBit) {
    Random random(3);
    int dark = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Receiver receiver = random.receiver({9, 7});
        const Light light = random.lightNear(receiver);
        const std::vector<double> values = unoccludedIrradiance(receiver, light);
        for (int row = 0; row < 7; ++row)
            for (int column = 0; column < 9; ++column) {
                const double expected =
                    pi * formFactor(receiver.texelCentre(column, row), receiver.normal, light.polygons[0]);
                EXPECT_EQ(at(values, receiver, column, row), expected);
                dark += expected == 0.0;
            }
    }
    EXPECT_GT(dark, 1000);  // horizons and backs were among them
}

TEST(AccumulationExact, InterpolatedTexturesAreWithinFloatRounding) {
    Random random(8);
    double worst = 0.0;
    int dark = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Receiver receiver = random.receiver({10 + random.below(90), 10 + random.below(90)});
        const Light light = random.lightNear(receiver);
        const std::vector<double> exact = unoccludedIrradiance(receiver, light);
        const std::vector<float> floats = unoccludedTexture(receiver, light);
        ASSERT_EQ(floats.size(), exact.size());
        for (std::size_t i = 0; i < exact.size(); ++i) {
            if (exact[i] > 1e-30) worst = std::max(worst, std::abs(floats[i] / exact[i] - 1.0));
            if (exact[i] == 0.0) {
                ASSERT_EQ(floats[i], 0.0f);
            }
            dark += exact[i] == 0.0;
        }
    }
    EXPECT_LT(worst, 1e-7);
    EXPECT_GT(dark, 1000);
    RecordProperty("worst", std::to_string(worst));
    const std::vector<double> exact = unoccludedIrradiance(figureReceiver(256), squareLight());
    const std::vector<float> floats = unoccludedTexture(figureReceiver(256), squareLight());
    for (std::size_t i = 0; i < exact.size(); ++i) ASSERT_NEAR(floats[i] / exact[i], 1.0, 6.2e-8);
}

// The last tiles overlap those before them, perhaps on another thread: each row belongs to one band. 16 rows
// are the same with 8 more below them as without, where else they would be interpolated from row 8 on.
TEST(AccumulationExact, RowsBelongToOneBandOfTiles) {
    for (double height = 0.3; height < 2.3; height += 0.05) {
        const Light light =
            areaLight({{-0.5, -0.5, height}, {-0.5, 0.5, height}, {0.5, 0.5, height}, {0.5, -0.5, height}});
        const dvec3 corner(-1.2, -1.2, 0);
        const std::vector<float> low = unoccludedTexture(
                                     receiverOn(corner, {1.6, 0, 0}, {0, 0.4, 0}, {64, 16}), light),
                                 high = unoccludedTexture(
                                     receiverOn(corner, {1.6, 0, 0}, {0, 0.6, 0}, {64, 24}), light);
        for (std::size_t i = 0; i < low.size(); ++i) ASSERT_EQ(high[i], low[i]) << height << " " << i;
    }
}

TEST(AccumulationExact, UmbraIsExactlyDark) {
    const Receiver floor = receiverOn({-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {32, 32});
    const Triangle lid = {dvec3(-3, -3, 1), dvec3(3, -3, 1), dvec3(0, 4, 1)};
    for (const double value : exactIrradiance(floor, squareLight(), {&lid, 1}).values) EXPECT_EQ(value, 0.0);
}

TEST(AccumulationExact, LightAcrossTheHorizon) {
    // A wall light half below: the same as its upper half, shadowed or not.
    const Light light = areaLight({{2, -1, -1}, {2, -1, 1}, {2, 1, 1}, {2, 1, -1}});
    const Light upper = areaLight({{2, -1, 0}, {2, -1, 1}, {2, 1, 1}, {2, 1, 0}});
    const Triangle post = {dvec3(1, 0, -0.5), dvec3(1, 0.2, -0.5), dvec3(1, 0.1, 0.4)};
    const Receiver floor = figureReceiver(33);
    const auto a = exactIrradiance(floor, light, {&post, 1}), b = exactIrradiance(floor, upper, {&post, 1});
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-15);
    EXPECT_GT(*std::max_element(a.values.begin(), a.values.end()), 0.1);
}

TEST(AccumulationExact, OccludersThroughTheReceiverAreCutAtIt) {
    const Triangle through = {dvec3(-0.3, 0, -1), dvec3(0.3, 0, -1), dvec3(0, 0, 1)};
    const Triangle above = {dvec3(-0.15, 0, 0), dvec3(0.15, 0, 0), dvec3(0, 0, 1)};
    const Receiver floor = receiverOn({-1.2, -1.1, 0}, {2.4, 0, 0}, {0, 2.4, 0}, {40, 41});
    const auto a = exactIrradiance(floor, squareLight(), {&through, 1});
    const auto b = exactIrradiance(floor, squareLight(), {&above, 1});
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-14);
    EXPECT_NE(a.values, unoccludedIrradiance(floor, squareLight()));
}

TEST(AccumulationExact, OccludersThroughTheLightsPlaneAreCutAtIt) {
    const Triangle through = {dvec3(0.1, 0.7, 4), dvec3(0.1, -0.7, 4), dvec3(0.1, 0, 0.5)};
    const double half = 0.7 * 1.5 / 3.5;
    const Triangle below = {dvec3(0.1, half, 2), dvec3(0.1, -half, 2), dvec3(0.1, 0, 0.5)};
    const Receiver floor = figureReceiver(40);
    const auto a = exactIrradiance(floor, squareLight(), {&through, 1});
    const auto b = exactIrradiance(floor, squareLight(), {&below, 1});
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-13);
    EXPECT_NE(a.values, unoccludedIrradiance(floor, squareLight()));
}

TEST(AccumulationExact, TrianglesWithoutAreaAndInThePlaneChangeNothing) {
    const Receiver floor = figureReceiver(24);
    const std::vector<Triangle> nothing = {{dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(1, 0, 1)},
                                           {dvec3(0, 0, 1), dvec3(0.2, 0, 1), dvec3(0.4, 0, 1)},
                                           {dvec3(-1, -1, 0), dvec3(1, -1, 0), dvec3(0, 1, 0)},
                                           {dvec3(-1, -1, 2), dvec3(1, -1, 2), dvec3(0, 1, 2)}};
    const std::vector<double> lit = unoccludedIrradiance(floor, squareLight());
    EXPECT_EQ(exactIrradiance(floor, squareLight(), nothing).values, lit);
    EXPECT_EQ(exactIrradiance(floor, squareLight(), nothing, false).values, lit);
}

TEST(AccumulationExact, OverlappingOccludersCountOnce) {
    const Receiver floor = figureReceiver(32);
    const Triangle t = figureTriangle;
    const std::vector<Triangle> thrice = {t, t, {t[1], t[0], t[2]}};
    const auto once = exactIrradiance(floor, squareLight(), {&t, 1}),
               often = exactIrradiance(floor, squareLight(), thrice);
    for (std::size_t i = 0; i < once.values.size(); ++i) EXPECT_NEAR(often.values[i], once.values[i], 1e-15);
}

// A light that shines both ways is two lights; each lights its own side.
TEST(AccumulationExact, TwoSidedLightsAreTwoLights) {
    const Light down = squareLight();
    const Light up = areaLight({down.polygons[0].rbegin(), down.polygons[0].rend()});
    const Receiver floor = figureReceiver(8);
    const Receiver ceiling = receiverOn({-1.2, -1.2, 4}, {0, 2.4, 0}, {2.4, 0, 0}, {8, 8});
    const std::vector<double> below = unoccludedIrradiance(floor, down),
                              above = unoccludedIrradiance(ceiling, up);
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(unoccludedIrradiance(floor, up)[i], 0.0);
        EXPECT_EQ(unoccludedIrradiance(ceiling, down)[i], 0.0);
        EXPECT_GT(below[i], 0.05);
    }
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j) EXPECT_NEAR(below[8 * i + j], above[8 * j + i], 1e-15);
}

TEST(AccumulationExact, SeveralPolygonsAddUp) {
    Light halves = areaLight({{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0, 0.5, 2}, {0, -0.5, 2}});
    halves.polygons.push_back({{0, -0.5, 2}, {0, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}});
    halves.area = 1.0;
    const Triangle t = figureTriangle;
    const Receiver floor = figureReceiver(32);
    const auto a = exactIrradiance(floor, halves, {&t, 1}),
               b = exactIrradiance(floor, squareLight(), {&t, 1});
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-15);
}

TEST(AccumulationExact, LightsWithoutAnAreaCastHardShadows) {
    Random random(4);
    int dark = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Receiver receiver = random.receiver({13, 11});
        Light light;
        light.type =
            std::array{LightType::point, LightType::spot, LightType::directional}[std::size_t(trial % 3)];
        light.position = receiver.at({random.between(0, 1), random.between(0, 1)}) +
                         random.between(0.5, 2.0) * receiver.normal;
        light.direction = -glm::normalize(receiver.normal + 0.4 * random.inBox(1.0));
        light.emission = {7.0, 3.0, 1.0};  // must not count
        Scene scene = test_meshes::emptyScene();
        for (int i = 0; i < 4; ++i) addTriangles(scene, {random.triangleNear(receiver, light)});
        addClusters(scene);
        const ExactScene truth(scene);
        const auto exact =
            exactIrradiance(receiver, light, occludersBetween(scene, receiver, light).reaching);
        const std::vector<double> lit = unoccludedIrradiance(receiver, light);
        for (int row = 0; row < 11; ++row)
            for (int column = 0; column < 13; ++column) {
                const dvec3 x = receiver.texelCentre(column, row);
                const dvec3 target =
                    light.type == LightType::directional ? x - 100.0 * light.direction : light.position;
                const double value = at(lit, receiver, column, row);
                EXPECT_NEAR(value,
                            std::max(0.0, glm::dot(receiver.normal, directionToLight(light, x))) *
                                facingIrradiance(light, x).z,
                            1e-15);
                const bool hidden = truth.occluded(x, noTriangle, target);
                EXPECT_EQ(at(exact.values, receiver, column, row), hidden ? 0.0 : value) << trial;
                dark += hidden;
            }
    }
    EXPECT_GT(dark, 500);
}

}  // namespace
}  // namespace penumbra
