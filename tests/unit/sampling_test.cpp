#include "common/math/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace penumbra {
namespace {

/// Every elementary interval of area 1/count (a columns x b rows, a * b = count) holds exactly one point.
bool isNet(const std::vector<glm::dvec2>& points) {
    for (std::size_t columns = 1; columns <= points.size(); columns *= 2) {
        const std::size_t rows = points.size() / columns;
        std::set<std::size_t> cells;
        for (const glm::dvec2& p : points)
            cells.insert(std::size_t(p.x * double(columns)) * rows + std::size_t(p.y * double(rows)));
        if (cells.size() != points.size()) return false;
    }
    return true;
}

TEST(OwenSobol, EveryPrefixOfAPowerOfTwoIsANet) {
    for (std::uint32_t seed : {0u, 1u, 77u, 0xffffffffu}) {
        std::vector<glm::dvec2> points;
        for (std::uint32_t i = 0; i < 1024; ++i) points.push_back(owenSobol(i, seed));
        for (std::size_t count : {1, 2, 16, 64, 256, 1024}) {
            EXPECT_TRUE(isNet({points.begin(), points.begin() + long(count)}))
                << count << " points, seed " << seed;
        }
        for (const glm::dvec2& p : points) {
            EXPECT_TRUE(p.x >= 0.0 && p.x < 1.0 && p.y >= 0.0 && p.y < 1.0);
            EXPECT_NE(p.x, p.y) << "both coordinates scrambled alike";
        }
    }
}

TEST(OwenSobol, PatternsOfTwoSeedsAreIndependentPointByPoint) {
    // Paired by their index, as a pixel's sample and its light sample are. Of 64 points 32 lie left in each
    // pattern; how many lie left in both is hypergeometric: mean 16, standard deviation 2. If the order of
    // the points were not shuffled, it would be 0 or 32, whatever the seeds.
    double mean = 0.0, variance = 0.0;
    constexpr int trials = 1000;
    for (std::uint32_t trial = 0; trial < trials; ++trial) {
        int both = 0;
        for (std::uint32_t i = 0; i < 64; ++i)
            both += owenSobol(i, hashSeed(trial, 1)).x < 0.5 && owenSobol(i, hashSeed(trial, 2)).x < 0.5;
        mean += double(both) / trials;
        variance += (both - 16.0) * (both - 16.0) / trials;
    }
    EXPECT_NEAR(mean, 16.0, 1.0);
    EXPECT_LT(variance, 64.0);
}

TEST(OwenSobol, IsUnbiasedAndItsErrorFallsAsItShould) {
    // Half-plane through the square, exact area by symmetry 1/2: rms error over seeds falls as N^-3/4
    // (Alexander 1990).
    const auto rms = [](std::uint32_t count) {
        double sum2 = 0.0, sum = 0.0;
        constexpr int trials = 600;
        for (std::uint32_t trial = 0; trial < trials; ++trial) {
            const double angle = 2.0 * std::numbers::pi * trial * std::numbers::phi;
            const glm::dvec2 normal(std::cos(angle), std::sin(angle));
            double inside = 0.0;
            for (std::uint32_t i = 0; i < count; ++i)
                inside += glm::dot(owenSobol(i, hashSeed(trial, count)) - 0.5, normal) > 0.0;
            const double error = inside / count - 0.5;
            sum += error;
            sum2 += error * error;
        }
        EXPECT_LE(std::abs(sum / trials), 3.0 * std::sqrt(sum2 / trials / trials));
        return std::sqrt(sum2 / trials);
    };
    const double coarse = rms(16), fine = rms(1024);
    EXPECT_LE(coarse, 0.05);
    const double slope = std::log(fine / coarse) / std::log(64.0);
    EXPECT_NEAR(slope, -0.75, 0.05);
}

TEST(HashSeed, DependsOnEveryArgument) {
    std::set<std::uint32_t> seeds;
    for (std::uint32_t a = 0; a < 16; ++a)
        for (std::uint32_t b = 0; b < 16; ++b)
            for (std::uint32_t c = 0; c < 16; ++c) seeds.insert(hashSeed(a, b, c));
    EXPECT_EQ(seeds.size(), 4096u);
    EXPECT_EQ(hashSeed(1, 2, 3), hashSeed(1, 2, 3));
}

/// Mean position of mapped stratified points: the centroid, if the map preserves area.
template <class Map>
glm::dvec3 meanOf(const Map& map) {
    glm::dvec3 sum(0.0);
    constexpr int n = 256;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) sum += map(glm::dvec2((x + 0.5) / n, (y + 0.5) / n));
    return sum / double(n * n);
}

TEST(PointInTriangle, CoversTheTriangleEvenly) {
    const glm::dvec3 a(0, 0, 0), b(3, 0, 1), c(1, 2, 0);
    const glm::dvec3 mean = meanOf([&](const glm::dvec2& u) { return pointInTriangle(a, b, c, u); });
    EXPECT_LE(glm::length(mean - (a + b + c) / 3.0), 1e-4);
    for (const glm::dvec2& u : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
        const glm::dvec3 p = pointInTriangle(a, b, c, u);
        EXPECT_GE(p.y, 0.0);
        EXPECT_LE(p.y, 2.0);
    }
}

TEST(PointInPolygon, GivesEachTriangleItsShare) {
    // An L-free but lopsided pentagon in the plane z = 0; centroid by the shoelace formula.
    const std::vector<glm::dvec3> p = {{0, 0, 0}, {4, 0, 0}, {5, 1, 0}, {2, 3, 0}, {0, 2, 0}};
    glm::dvec2 centroid(0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec3 &q = p[i], &r = p[(i + 1) % p.size()];
        const double twice = q.x * r.y - r.x * q.y;
        area += 0.5 * twice;
        centroid += twice * glm::dvec2(q + r) / 6.0;
    }
    centroid /= area;
    EXPECT_NEAR(polygonArea(p), area, 1e-14 * area);
    const glm::dvec3 mean = meanOf([&](const glm::dvec2& u) { return pointInPolygon(p, u); });
    EXPECT_NEAR(mean.x, centroid.x, 2e-3);
    EXPECT_NEAR(mean.y, centroid.y, 2e-3);
}

TEST(PointInPolygon, AQuadrilateralThatIsNoParallelogramGoesByTriangles) {
    const std::vector<glm::dvec3> trapezium = {{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    const glm::dvec3 mean = meanOf([&](const glm::dvec2& u) { return pointInPolygon(trapezium, u); });
    // A square and half a square: ((1, 1) * 4 + (8/3, 2/3) * 2) / 6. A column of 256 may fall into the wrong
    // triangle.
    EXPECT_NEAR(mean.x, 14.0 / 9.0, 4.0 / 256);
    EXPECT_NEAR(mean.y, 8.0 / 9.0, 4.0 / 256);
}

TEST(PointInPolygon, MapsAParallelogramDirectly) {
    const std::vector<glm::dvec3> square = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};
    EXPECT_EQ(pointInPolygon(square, {0.25, 0.75}), glm::dvec3(-0.5, 2, 0.5));
}

TEST(ConcentricDisk, PreservesAreaAndStaysInside) {
    double second = 0.0, first = 0.0;
    constexpr int n = 512;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const glm::dvec2 d = concentricDisk({(x + 0.5) / n, (y + 0.5) / n});
            EXPECT_LE(glm::length(d), 1.0);
            second += glm::dot(d, d);
            first += d.x * d.x;
        }
    }
    EXPECT_NEAR(first / (n * n), 0.25, 1e-5) << "no wedge covered twice";
    EXPECT_NEAR(second / (n * n), 0.5, 1e-5);  // E[r^2] of a uniform disk
    EXPECT_EQ(concentricDisk({0.5, 0.5}), glm::dvec2(0.0));
    EXPECT_LE(glm::length(concentricDisk({1.0, 0.5}) - glm::dvec2(1.0, 0.0)), 1e-15);
}

}  // namespace
}  // namespace penumbra
