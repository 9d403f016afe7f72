// Lambert's formula and cone subtraction against golden values, other formulas, and themselves under stress.
#include "common/truth/polygon_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/unit/figure_two.h"
#include "tests/unit/polygon_light_reference.h"

namespace penumbra {
namespace {

using glm::dvec3;

using figure_two::light, figure_two::triangle;
const dvec3 up(0, 0, 1);

double visible(const dvec3& x, std::span<const Triangle> occluders) {
    return visibleFormFactor(x, up, light, occluders);
}

TEST(PolygonLight, GoldenValues) {
    for (const auto& g : figure_two::golden) {
        EXPECT_NEAR(formFactor(g.x, up, light), g.whole, 2e-15);  // the table has 15 decimals
        EXPECT_NEAR(visible(g.x, {&triangle, 1}), g.visible, 2e-15);
    }
}

TEST(PolygonLight, GoldenMean) {
    constexpr int size = 512;
    double sum = 0.0;
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            sum += visible({-1.2 + 2.4 * (i + 0.5) / size, -1.2 + 2.4 * (j + 0.5) / size, 0}, {&triangle, 1});
    EXPECT_NEAR(sum / (size * size), 0.039284125595, 1e-12);
}

TEST(PolygonLight, SquareOverItsCentre) {
    for (const double height : {0.01, 0.1, 0.5, 1.0, 2.0, 10.0, 1e3, 1e6}) {
        std::vector<dvec3> square = light;
        for (dvec3& p : square) p.z = height;
        const double exact = centredSquareFormFactor(1.0, height);
        EXPECT_NEAR(formFactor({0, 0, 0}, up, square) / exact, 1.0, 2e-15) << "height " << height;
    }
}

// Without the constant taken out of every edge's term, the error is 1e-13 at 1e2 and 1e-9 at 1e6 sizes.
TEST(PolygonLight, RelativeErrorAtAnyDistance) {
    std::mt19937 random(3);
    for (const double distance : {1.0, 3.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e9}) {
        double worst = 0.0;
        for (int trial = 0; trial < 500; ++trial) {
            const TiltedSquare s = randomTiltedSquare(distance, random);
            const double exact = distance < 30.0 ? longDoubleFormFactor(s.normal, s.corners)
                                                 : gaussFormFactor(s.normal, s.corners);
            worst = std::max(worst, std::abs(formFactor({0, 0, 0}, s.normal, s.corners) / exact - 1.0));
        }
        EXPECT_LT(worst, 1e-14) << "distance/size " << distance;
    }
}

TEST(PolygonLight, OnlyTheFrontEmits) {
    std::vector<dvec3> back(light.rbegin(), light.rend());
    EXPECT_EQ(formFactor({0, 0, 0}, up, back), 0.0);
    EXPECT_EQ(formFactor({0, 0, 4}, -up, light), 0.0);
    EXPECT_GT(formFactor({0, 0, 4}, -up, back), 0.07);
    EXPECT_EQ(formFactor({0, 0, 0}, -up, light), 0.0);  // below the receiver's horizon
}

TEST(PolygonLight, InTheLightsPlaneIsDark) {
    for (const dvec3& x : {dvec3(0, 0, 2), dvec3(0.5, 0, 2), dvec3(0.5, 0.5, 2), dvec3(3, 0, 2)}) {
        EXPECT_EQ(formFactor(x, up, light), 0.0);
        EXPECT_EQ(formFactor(x, dvec3(1, 0, 0), light), 0.0);
    }
    EXPECT_NEAR(formFactor({0, 0, 2 - 1e-9}, up, light), 1.0, 1e-8);  // just below it the light fills the sky
}

TEST(PolygonLight, HorizonHalvesALightThatStraddlesIt) {
    // The wall light x = 1, symmetric about the horizon: seen edge-on along x its halves are equal, tilting
    // selects one.
    const std::vector<dvec3> wall = {{1, -0.5, -0.5}, {1, -0.5, 0.5}, {1, 0.5, 0.5}, {1, 0.5, -0.5}};
    const std::vector<dvec3> upperHalf = {{1, -0.5, 0}, {1, -0.5, 0.5}, {1, 0.5, 0.5}, {1, 0.5, 0}};
    EXPECT_GT(formFactor({0, 0, 0}, up, wall), 0.01);
    EXPECT_NEAR(formFactor({0, 0, 0}, up, wall), formFactor({0, 0, 0}, up, upperHalf), 1e-16);
    EXPECT_NEAR(formFactor({0, 0, 0}, up, wall), longDoubleFormFactor(up, upperHalf), 1e-16);
}

TEST(PolygonLight, ManyCorners) {
    std::vector<dvec3> disk;
    for (int i = 0; i < 64; ++i) {
        const double angle = -2.0 * std::numbers::pi * i / 64;
        disk.push_back({0.5 * std::cos(angle), 0.5 * std::sin(angle), 2.0});
    }
    const dvec3 x(0.3, 0.2, 0);
    double fan = 0.0;
    for (std::size_t i = 1; i + 1 < disk.size(); ++i)
        fan += formFactor(x, up, std::vector<dvec3>{disk[0], disk[i], disk[i + 1]});
    EXPECT_NEAR(formFactor(x, up, disk), fan, 1e-15);
    EXPECT_NEAR(formFactor({0, 0, 0}, up, disk), 0.25 / (0.25 + 4.0), 1e-4);  // a round disk on its axis
}

// Cutting a square by one big triangle along each side of a 40-gon leaves the 40-gon: pieces with many
// corners.
TEST(PolygonLight, ManyOccludersLeaveAPolygonOfManyCorners) {
    std::vector<dvec3> inner;
    for (int i = 0; i < 40; ++i) {
        const double angle = -2.0 * std::numbers::pi * i / 40;
        inner.push_back({0.4 * std::cos(angle), 0.4 * std::sin(angle), 2.0});
    }
    const dvec3 x(0.1, -0.2, 0);
    std::vector<Triangle> around;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const dvec3 a = 0.5 * (inner[i] + x), b = 0.5 * (inner[(i + 1) % inner.size()] + x);
        const dvec3 outwards = 0.5 * (a + b) - 0.5 * (dvec3(0, 0, 2) + x);
        around.push_back({a + 20.0 * (a - b), b + 20.0 * (b - a), a + 40.0 * outwards});
    }
    EXPECT_NEAR(visible(x, around), formFactor(x, up, inner), 1e-14);
}

TEST(PolygonLight, OffsetByAMillion) {
    for (const double offset : {1e3, 1e6}) {
        for (const dvec3& x : {dvec3(0, 0, 0), dvec3(0.5, 0, 0), dvec3(-0.3, 0.4, 0), dvec3(0, -0.8, 0)}) {
            std::vector<dvec3> movedLight = light;
            for (dvec3& p : movedLight) p += offset;
            Triangle moved = triangle;
            for (dvec3& p : moved) p += offset;
            const double value = visibleFormFactor(x + offset, up, movedLight, {&moved, 1});
            EXPECT_NEAR(value / visible(x, {&triangle, 1}), 1.0, 1e-9) << "offset " << offset;
        }
    }
}

}  // namespace
}  // namespace penumbra
