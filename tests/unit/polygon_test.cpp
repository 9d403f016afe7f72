// The clipper everything exact stands on: nothing lost, nothing counted twice, and the same bits on both
// sides of an edge.
#include "common/math/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "common/error.h"

namespace penumbra {
namespace {

Polygon2 regularPolygon(int corners, double radius = 1.0, const glm::dvec2& centre = {0, 0}) {
    Polygon2 p;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / corners;
        p.push(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return p;
}

TEST(Polygon, SplitLosesNoAreaAndAddsAtMostOneCorner) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int trial = 0; trial < 20000; ++trial) {
        const Polygon2 polygon = regularPolygon(3 + trial % 9);
        const glm::dvec2 normal(uniform(random), uniform(random));
        const double offset = 1.2 * uniform(random);
        Polygon2 inside, outside;
        split(
            polygon, [&](const glm::dvec2& p) { return glm::dot(normal, p) - offset; }, inside, outside);
        EXPECT_NEAR(area(inside) + area(outside), area(polygon), 1e-15 * polygon.count);
        EXPECT_GE(area(inside), 0.0);
        EXPECT_GE(area(outside), 0.0);
        EXPECT_LE(inside.count, polygon.count + 1);
        EXPECT_LE(outside.count, polygon.count + 1);
    }
}

TEST(Polygon, NeighboursAreCutAtTheSameBits) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int trial = 0; trial < 20000; ++trial) {
        const glm::dvec3 a(uniform(random), uniform(random), uniform(random) - 1.5);
        const glm::dvec3 b(uniform(random), uniform(random), uniform(random) + 1.5);
        const glm::dvec3 left(-3, uniform(random), -2), right(3, uniform(random), -2);
        const glm::dvec3 normal(uniform(random), uniform(random), 4.0);
        const auto distance = [&](const glm::dvec3& p) { return glm::dot(normal, p); };
        const auto cutOnAb = [&](std::initializer_list<glm::dvec3> triangle) {
            const Polygon3 upper = clip(Polygon3(std::span(triangle.begin(), 3)), distance);
            EXPECT_EQ(upper.count, 3);
            return upper;
        };
        const Polygon3 one = cutOnAb({a, b, left});
        const Polygon3 other = cutOnAb({b, a, right});
        int shared = 0;
        for (const glm::dvec3& p : one.span())
            for (const glm::dvec3& q : other.span()) shared += p == q ? 1 : 0;
        EXPECT_EQ(shared, 2);  // b, and the cut on the common edge
    }
}

TEST(Polygon, CornersOnTheLineBelongToBothSidesAndSliversVanish) {
    const Polygon2 square = regularPolygon(4);
    Polygon2 inside, outside;
    split(
        square, [](const glm::dvec2& p) { return p.x == 0.0 || std::abs(p.x) < 1e-15 ? 0.0 : p.x; }, inside,
        outside);
    EXPECT_EQ(inside.count, 3);
    EXPECT_EQ(outside.count, 3);
    split(
        square, [](const glm::dvec2& p) { return p.x - 1.0; }, inside, outside);  // touches one corner
    EXPECT_TRUE(inside.empty());
    EXPECT_EQ(outside.count, 4);
    split(
        inside, [](const glm::dvec2& p) { return p.x; }, inside, outside);
    EXPECT_TRUE(outside.empty());
}

TEST(Polygon, TooManyCornersIsAnErrorNotAnOverrun) {
    EXPECT_THROW(regularPolygon(Polygon2::capacity + 1), Error);
    EXPECT_NO_THROW(regularPolygon(Polygon2::capacity));
}

TEST(Polygon, AreaKeepsItsDigitsFarAway) {
    EXPECT_NEAR(area(regularPolygon(4, std::sqrt(0.5))), 1.0, 1e-15);
    const double shift = 67108864.0;  // 2^26: the corners of the unit square stay exact
    Polygon2 square;
    for (const glm::dvec2& p : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)})
        square.push(p + shift);
    EXPECT_EQ(area(square), 1.0);
}

TEST(Polygon, AreaNormalPointsToTheFront) {
    const glm::dvec3 square[] = {{0, 0, 5}, {2, 0, 5}, {2, 1, 5}, {0, 1, 5}};
    EXPECT_EQ(areaNormal(square), glm::dvec3(0, 0, 4));
}

}  // namespace
}  // namespace penumbra
