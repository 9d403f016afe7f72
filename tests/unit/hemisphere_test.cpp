#include "common/math/hemisphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace penumbra {
namespace {

constexpr double pi = std::numbers::pi;

TEST(FrameAround, IsOrthonormalAndRightHanded) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    const auto check = [](const glm::dvec3& n) {
        const glm::dmat3 frame = frameAround(n);
        EXPECT_EQ(frame[2], n);
        const glm::dmat3 unit = glm::transpose(frame) * frame;
        for (int i = 0; i < 3; ++i)
            EXPECT_LE(glm::length(unit[i] - glm::dmat3(1.0)[i]), 4e-16 * 4.0)
                << n.x << " " << n.y << " " << n.z;
        EXPECT_NEAR(glm::determinant(frame), 1.0, 1e-14);
    };
    for (int i = 0; i < 1000; ++i)
        check(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
    for (const double sign : {-1.0, 1.0}) {
        check({sign, 0, 0});
        check({0, sign, 0});
        check({0, 0, sign});
        check({0, sign, -0.0});
        check(glm::normalize(glm::dvec3(1e-9, 0.0, sign)));  // where frames made by a cross product break
        check(glm::normalize(glm::dvec3(1e-200, 1e-9, sign)));
    }
}

TEST(FrameAround, IsContinuousButAtTheEquator) {
    for (const double z : {-1.0, -0.5, 0.3, 1.0}) {
        const double s = std::sqrt(1.0 - z * z);
        const glm::dmat3 one = frameAround(glm::normalize(glm::dvec3(s, 0.1 * s, z)));
        const glm::dmat3 other = frameAround(glm::normalize(glm::dvec3(s + 1e-7, 0.1 * s - 1e-7, z)));
        EXPECT_LE(glm::length(one[0] - other[0]) + glm::length(one[1] - other[1]), 1e-6) << z;
    }
}

/// Mean over a fine grid of the unit square.
double meanOf(const std::function<double(const glm::dvec2&)>& f) {
    constexpr int n = 256;
    double sum = 0.0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) sum += f(glm::dvec2((x + 0.5) / n, (y + 0.5) / n));
    return sum / (n * n);
}

TEST(Directions, HaveTheDensityTheyClaim) {
    // Moments of z and x^2 z^k under cos/pi and 1/2pi, by hand. A grid's midpoint rule is off by n^-1.5 at
    // the rim, where z falls like a root.
    const double rule = std::pow(256.0, -1.5);
    EXPECT_NEAR(meanOf([](const glm::dvec2& u) { return cosineDirection(u).z; }), 2.0 / 3.0, rule);
    EXPECT_NEAR(meanOf([](const glm::dvec2& u) { return uniformDirection(u).z; }), 0.5, rule);
    const auto second = [](const glm::dvec3& w) { return w.x * w.x - w.y * w.y + w.x * w.y; };
    EXPECT_NEAR(meanOf([&](const glm::dvec2& u) { return second(cosineDirection(u)); }), 0.0, rule);
    EXPECT_NEAR(meanOf([&](const glm::dvec2& u) { return second(uniformDirection(u)); }), 0.0, rule);
    EXPECT_NEAR(meanOf([](const glm::dvec2& u) { return std::pow(cosineDirection(u).x, 2); }), 0.25, rule);
    EXPECT_NEAR(meanOf([](const glm::dvec2& u) { return std::pow(uniformDirection(u).x, 2); }), 1.0 / 3.0,
                rule);
    // A wedge of directions: 1/pi int over x > |y| ... a quarter of them, by symmetry.
    const auto quarter = [](const glm::dvec3& w) { return w.x > std::abs(w.y) ? 1.0 : 0.0; };
    EXPECT_NEAR(meanOf([&](const glm::dvec2& u) { return quarter(cosineDirection(u)); }), 0.25, 2e-3);
    EXPECT_NEAR(meanOf([&](const glm::dvec2& u) { return quarter(uniformDirection(u)); }), 0.25, 2e-3);
}

TEST(Directions, AreUnitAndAboveTheHorizon) {
    const double below1 = std::nextafter(1.0, 0.0);
    for (const double x : {0.0, 1e-17, 0.3, 0.5, 0.999, below1})
        for (const double y : {0.0, 1e-17, 0.3, 0.5, 0.999, below1})
            for (const glm::dvec3& w : {cosineDirection({x, y}), uniformDirection({x, y})}) {
                EXPECT_NEAR(glm::length(w), 1.0, 3e-16);
                EXPECT_GE(w.z, 0.0);
            }
    EXPECT_EQ(uniformDirection({0.25, 0.0}).z, 0.75);
    EXPECT_EQ(cosineDirection({0.5, 0.5}), glm::dvec3(0, 0, 1));
}

/// Largest error, over many caps, of the share of points that lie in them.
double capError(const std::vector<glm::dvec3>& points) {
    std::mt19937_64 random(2);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> height(-1.0, 1.0);
    double worst = 0.0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const double z = height(random);
        double inside = 0.0;
        for (const glm::dvec3& p : points) inside += glm::dot(p, axis) > z;
        worst = std::max(worst, std::abs(inside / double(points.size()) - 0.5 * (1.0 - z)));
    }
    return worst;
}

double separation(const std::vector<glm::dvec3>& points) {
    double least = 4.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) least = std::min(least, glm::distance(points[i], points[j]));
    return least;
}

TEST(WholeSphere, IsCoveredEvenly) {
    for (const int count : {64, 512, 1000}) {
        std::vector<glm::dvec3> fibonacci;
        for (int i = 0; i < count; ++i) fibonacci.push_back(fibonacciSphere(i, count));
        const std::vector<glm::dvec3> sobol = owenSobolSphere(count, 5);
        ASSERT_EQ(sobol.size(), std::size_t(count));
        for (const auto& points : {fibonacci, sobol}) {
            glm::dvec3 sum(0.0);
            for (const glm::dvec3& p : points) {
                EXPECT_NEAR(glm::length(p), 1.0, 3e-16);
                sum += p;
            }
            EXPECT_LE(glm::length(sum) / count, 4.0 / count);
            // Random points would be off by about 3.5 standard deviations in the worst of 500 caps.
            EXPECT_LE(capError(points), 0.5 * 3.5 * 0.5 / std::sqrt(count)) << count;
        }
        // Neighbours of a good lattice of N points keep a distance of about sqrt(4 pi / N).
        EXPECT_GE(separation(fibonacci), 0.8 * std::sqrt(4.0 * pi / count)) << count;
    }
    EXPECT_NE(owenSobolSphere(4, 1)[0], owenSobolSphere(4, 2)[0]) << "the seed matters";
    EXPECT_EQ(owenSobolSphere(16, 7)[3], owenSobolSphere(8, 7)[3]) << "a prefix of the same sequence";
}

}  // namespace
}  // namespace penumbra
