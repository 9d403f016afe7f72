// The limits of percentage-closer filtering against brute-force integration of the same kernel.
#include "common/truth/edge_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace penumbra {
namespace {

/// Mean of `lit(point)` over the points of [-1,1]^2 in `kernel`, on an n x n grid.
double integrate(const std::function<bool(glm::dvec2)>& kernel, const std::function<bool(glm::dvec2)>& lit) {
    constexpr int n = 1000;
    int inside = 0, bright = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const glm::dvec2 p(2.0 * (i + 0.5) / n - 1.0, 2.0 * (j + 0.5) / n - 1.0);
            if (!kernel(p)) continue;
            ++inside;
            bright += lit(p) ? 1 : 0;
        }
    return double(bright) / inside;
}

bool inUnitDisk(glm::dvec2 p) {
    return glm::dot(p, p) <= 1.0;
}

TEST(EdgeCoverage, Disk) {
    for (const double u : {-0.95, -0.5, -0.1, 0.0, 0.3, 0.8}) {
        const double sampled = integrate(inUnitDisk, [u](glm::dvec2 p) { return p.x < u; });
        EXPECT_NEAR(diskCoverage(2.5 * u, 2.5), sampled, 1e-3) << "distance " << u;
        EXPECT_NEAR(diskCoverage(u, 1.0) + diskCoverage(-u, 1.0), 1.0, 1e-15);
    }
    EXPECT_EQ(diskCoverage(1.0, 1.0), 1.0);
    EXPECT_EQ(diskCoverage(-1.0, 1.0), 0.0);
    EXPECT_EQ(diskCoverage(7.0, 1.0), 1.0);
    EXPECT_EQ(diskCoverage(-7.0, 1.0), 0.0);
    EXPECT_EQ(diskCoverage(0.1, 0.0), 1.0);
    EXPECT_EQ(diskCoverage(-0.1, 0.0), 0.0);
}

TEST(EdgeCoverage, Box) {
    for (const double angle : {0.0, 0.2, 0.7853981633974483, 1.2, 1.5707963267948966, 2.5, -0.4}) {
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        for (const double d : {-1.3, -0.9, -0.4, 0.0, 0.25, 0.7, 1.1}) {
            const double sampled = integrate([](glm::dvec2) { return true; },
                                             [&](glm::dvec2 p) { return glm::dot(normal, p) < d; });
            EXPECT_NEAR(boxCoverage(d, 2.0, 3.0 * normal), sampled, 1.1e-3)
                << "angle " << angle << " distance " << d;
        }
    }
    EXPECT_EQ(boxCoverage(0.25, 1.0, {1, 0}), 0.75);
    EXPECT_EQ(boxCoverage(-9.0, 1.0, {1, 1}), 0.0);
    EXPECT_EQ(boxCoverage(9.0, 1.0, {1, 1}), 1.0);
    EXPECT_EQ(boxCoverage(1e-9, 0.0, {1, 1}), 1.0);
}

TEST(EdgeCoverage, BoxIsSmoothAcrossItsPieces) {
    for (const double angle : {1e-12, 1e-6, 0.3, 0.7853981633974483}) {
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        double previous = 0.0;
        for (double d = -1.0; d <= 1.0; d += 1e-4) {
            const double now = boxCoverage(d, 1.0, normal);
            EXPECT_GE(now, previous - 1e-15);
            EXPECT_LE(now - previous, 1.5e-4);
            previous = now;
        }
        EXPECT_EQ(previous, 1.0);
    }
}

TEST(EdgeCoverage, BilinearGridIsOneRampOverTexels) {
    for (const int k : {0, 1, 2, 4}) {
        for (double look = -k - 2.0; look <= k + 2.0; look += 0.01) {
            double sum = 0.0, lit = 0.0;
            for (int texel = -12; texel < 12; ++texel) {  // texel i covers [i, i+1]; those from 0 on are lit
                const double weight = bilinearCompareWeight(texel + 0.5 - look, k);
                sum += weight;
                lit += texel >= 0 ? weight : 0.0;
            }
            EXPECT_NEAR(sum, 1.0, 1e-14);
            EXPECT_NEAR(lit, bilinearCompareRamp(look, k), 1e-14) << "k " << k << " look-up at " << look;
        }
    }
}

TEST(EdgeCoverage, BlobAndBar) {
    for (const double a : {0.1, 0.5, 0.9}) {
        EXPECT_NEAR(blobCoverage(3.0 * a, 3.0),
                    integrate(inUnitDisk, [a](glm::dvec2 p) { return glm::dot(p, p) > a * a; }), 1e-3);
        EXPECT_NEAR(barCoverage(3.0 * a, 3.0),
                    integrate(inUnitDisk, [a](glm::dvec2 p) { return std::abs(p.y) > a; }), 1.5e-3);
        // A bar is what two half-planes leave.
        EXPECT_NEAR(barCoverage(a, 1.0), 2.0 * diskCoverage(-a, 1.0), 1e-15);
    }
    EXPECT_EQ(blobCoverage(2.0, 1.0), 0.0);
    EXPECT_EQ(blobCoverage(0.0, 1.0), 1.0);
    EXPECT_NEAR(barCoverage(2.0, 1.0), 0.0, 1e-16);
    EXPECT_EQ(barCoverage(0.0, 1.0), 1.0);
}

}  // namespace
}  // namespace penumbra
