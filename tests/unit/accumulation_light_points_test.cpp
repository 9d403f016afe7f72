// Points on lights: in their cells, on the light, by area, of equal weight.
#include "chapters/08_accumulation/light_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "common/error.h"
#include "common/truth/polygon_light.h"
#include "tests/unit/accumulation_scenes.h"

namespace penumbra {
namespace {

using namespace accumulation_scenes;

constexpr LightPattern patterns[] = {LightPattern::regular, LightPattern::jittered, LightPattern::fibonacci,
                                     LightPattern::owenSobol};
constexpr LightPattern grids[] = {LightPattern::regular, LightPattern::jittered};

/// The unit square as a light: its points are the pattern.
Light unitSquare() {
    return areaLight({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
}

double totalWeight(const std::vector<LightPoint>& points) {
    return std::accumulate(points.begin(), points.end(), 0.0,
                           [](double sum, const LightPoint& p) { return sum + p.weight; });
}

/// Irradiance over pi at `x`, by the points.
double estimate(const std::vector<LightPoint>& points, const Light& light, const dvec3& x, const dvec3& n) {
    double sum = 0.0;
    for (const LightPoint& point : points) {
        const dvec3 d = point.position - x;
        const double r2 = glm::dot(d, d);
        sum += point.weight * std::max(0.0, glm::dot(n, d)) * std::max(0.0, -glm::dot(light.direction, d)) /
               (r2 * r2);
    }
    return sum / 3.14159265358979323846;
}

TEST(AccumulationLightPoints, HeckbertAndHerfsFourPoints) {
    const std::vector<LightPoint> points = lightPoints(unitSquare(), 4, LightPattern::regular, 1);
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[0].position, dvec3(0.25, 0.25, 0));
    EXPECT_EQ(points[1].position, dvec3(0.75, 0.25, 0));
    EXPECT_EQ(points[2].position, dvec3(0.25, 0.75, 0));
    EXPECT_EQ(points[3].position, dvec3(0.75, 0.75, 0));
    for (const LightPoint& p : points) EXPECT_EQ(p.weight, 0.25);
}

TEST(AccumulationLightPoints, OnePointIsTheCentre) {
    const Light light = squareLight();
    EXPECT_EQ(lightPoints(light, 1, LightPattern::regular, 9)[0].position, light.position);
}

TEST(AccumulationLightPoints, AnyCountFillsItsGrid) {
    for (const int count : {1, 2, 3, 5, 7, 12, 31, 64, 100, 127, 1000, 4096}) {
        const int rows = std::max(1, int(std::lround(std::sqrt(count))));
        for (const LightPattern pattern : grids) {
            const std::vector<LightPoint> points = lightPoints(unitSquare(), count, pattern, 5);
            ASSERT_EQ(int(points.size()), count);
            int index = 0;
            for (int row = 0; row < rows; ++row) {
                const int first = index, end = int(std::int64_t(row + 1) * count / rows);
                for (; index < end; ++index) {
                    const dvec3& p = points[std::size_t(index)].position;
                    EXPECT_EQ(int(p.x * (end - first)), index - first) << count;
                    EXPECT_GE(p.y, double(first) / count) << count;
                    EXPECT_LE(p.y, double(end) / count) << count;
                }
            }
            EXPECT_EQ(index, count);
        }
    }
}

TEST(AccumulationLightPoints, EveryPointOnTheLightAndOfItsShare) {
    Random random(4);
    for (int trial = 0; trial < 100; ++trial) {
        const dvec3 normal = random.direction();
        const Light light = areaLight(random.polygon(random.inBox(3.0), normal, random.between(0.1, 2.0)));
        for (const LightPattern pattern : patterns) {
            const int count = 1 + random.below(300);
            const std::vector<LightPoint> points = lightPoints(light, count, pattern, unsigned(trial));
            EXPECT_NEAR(totalWeight(points), light.area, 1e-12);
            const Corners& polygon = light.polygons[0];
            for (const LightPoint& point : points) {
                EXPECT_FALSE(point.atInfinity);
                EXPECT_NEAR(glm::dot(point.position - polygon[0], normal), 0.0, 1e-12);
                for (std::size_t i = 0; i < polygon.size(); ++i) {
                    const dvec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
                    EXPECT_GE(glm::dot(glm::cross(edge, point.position - polygon[i]), normal), -1e-12);
                }
            }
        }
    }
}

TEST(AccumulationLightPoints, PolygonsByArea) {
    Light light = areaLight({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}});
    light.polygons.push_back({{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
    light.area = 4.0;
    for (const LightPattern pattern : patterns) {
        int upper = 0;
        for (const LightPoint& p : lightPoints(light, 1024, pattern, 3)) upper += p.position.y > 1.0;
        EXPECT_NEAR(upper, 256, 16) << int(pattern);
    }
}

TEST(AccumulationLightPoints, SeedsDifferAndRepeat) {
    for (const LightPattern pattern : patterns) {
        const auto one = lightPoints(unitSquare(), 16, pattern, 1),
                   again = lightPoints(unitSquare(), 16, pattern, 1);
        const auto other = lightPoints(unitSquare(), 16, pattern, 2);
        bool differs = false;
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_EQ(one[i].position, again[i].position);
            differs = differs || one[i].position != other[i].position;
        }
        EXPECT_EQ(differs, pattern != LightPattern::regular);
    }
}

// The lit column of the convergence table: smooth integrands, so every pattern beats N^-1/2 by far.
TEST(AccumulationLightPoints, ConvergeToLambertsFormula) {
    const Light light = squareLight();
    const dvec3 x(0.4, -0.3, 0), n(0, 0, 1);
    const double exact = formFactor(x, n, light.polygons[0]);
    const double bounds[] = {1e-4, 1e-3, 1e-3, 1e-4};
    for (std::size_t i = 0; i < 4; ++i) {
        double worst = 0.0;
        for (std::uint32_t seed = 0; seed < 20; ++seed)
            worst = std::max(
                worst,
                std::abs(estimate(lightPoints(light, 1024, patterns[i], seed), light, x, n) / exact - 1.0));
        EXPECT_LT(worst, bounds[i]) << i;
    }
}

TEST(AccumulationLightPoints, PatternsHaveNoTwoPointsAlike) {
    for (const LightPattern pattern : patterns) {
        std::set<std::pair<double, double>> seen;
        for (const LightPoint& p : lightPoints(unitSquare(), 4096, pattern, 7))
            seen.insert({p.position.x, p.position.y});
        EXPECT_EQ(seen.size(), 4096u);
    }
}

TEST(AccumulationLightPoints, LightsWithoutAnAreaAreOnePoint) {
    Light lamp;
    lamp.type = LightType::spot;
    lamp.position = {1, 2, 3};
    ASSERT_EQ(lightPoints(lamp, 64, LightPattern::owenSobol, 1).size(), 1u);
    EXPECT_EQ(lightPoints(lamp, 64, LightPattern::owenSobol, 1)[0].position, lamp.position);
    Light sun;
    sun.direction = glm::normalize(dvec3(1, -2, 0.5));
    const LightPoint point = lightPoints(sun, 64, LightPattern::owenSobol, 1)[0];
    EXPECT_TRUE(point.atInfinity);
    EXPECT_EQ(point.position, -sun.direction);
}

TEST(AccumulationLightPoints, CountsOutOfRange) {
    EXPECT_THROW(lightPoints(unitSquare(), 0, LightPattern::regular, 1), Error);
    EXPECT_THROW(lightPoints(unitSquare(), 4097, LightPattern::regular, 1), Error);
}

}  // namespace
}  // namespace penumbra
