// Cone subtraction where it could go wrong: the degenerate cases, a million random scenes, and two other ways
// to the same figure.
#include "common/truth/cone_subtraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "common/truth/polygon_light.h"
#include "tests/unit/figure_two.h"
#include "tests/unit/polygon_light_reference.h"

namespace penumbra {
namespace {

using glm::dvec3;

using figure_two::light, figure_two::triangle;
const dvec3 up(0, 0, 1);
const dvec3 inPenumbra(0.5, 0, 0);

double visible(const dvec3& x, const std::vector<Triangle>& occluders) {
    return visibleFormFactor(x, up, light, occluders);
}
double whole(const dvec3& x) {
    return formFactor(x, up, light);
}

// --- What must change nothing, to the bit.

TEST(ConeSubtraction, TrianglesWithoutSolidAngleChangeNothing) {
    for (const dvec3& x : {dvec3(0, 0, 0), inPenumbra, dvec3(-0.3, 0.4, 0)}) {
        for (const Triangle& t : {Triangle{triangle[0], triangle[0], triangle[1]},  // repeated vertex
                                  Triangle{triangle[0], triangle[1], triangle[1]},
                                  Triangle{triangle[2], triangle[2], triangle[2]},  // a point
                                  Triangle{triangle[0], 0.5 * (triangle[0] + triangle[1]), triangle[1]},
                                  Triangle{x, triangle[0], triangle[1]},  // x is a corner: edge-on
                                  Triangle{x + dvec3(-1, 0, 0), x + dvec3(1, 0, 0), x + dvec3(0, 0.1, 1)},
                                  Triangle{x + dvec3(-1, -1, 0), x + dvec3(1, -1, 0), x + dvec3(0, 1, 0)}}) {
            EXPECT_EQ(visible(x, {t}), whole(x));
            EXPECT_EQ(visible(x, {triangle, t}), visible(x, {triangle}));
            EXPECT_EQ(visible(x, {t, triangle}), visible(x, {triangle}));
        }
    }
}

TEST(ConeSubtraction, ASurfaceDoesNotShadowThePointsComputedOnIt) {
    std::mt19937 random(10);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto point = [&] { return dvec3(uniform(random), uniform(random), uniform(random)); };
    for (int trial = 0; trial < 20000; ++trial) {
        const dvec3 far = trial % 2 == 0 ? dvec3(0.0) : 1000.0 * point();
        Triangle surface = {far + point(), far + point(), far + point()};
        dvec3 n = glm::cross(surface[1] - surface[0], surface[2] - surface[0]);
        if (glm::length(n) < 0.1) continue;
        n = glm::normalize(n);
        // Half of these points are below the surface by a rounding error; some are beside it, in its plane.
        const double s = 0.4 + 0.5 * uniform(random), t = 0.3 + 0.5 * uniform(random);
        const dvec3 x = surface[0] + s * (surface[1] - surface[0]) + t * (surface[2] - surface[0]);
        const dvec3 u = glm::normalize(surface[1] - surface[0]), v = glm::cross(n, u), centre = x + 2.0 * n;
        const dvec3 polygon[] = {centre - u - v, centre - u + v, centre + u + v, centre + u - v};
        EXPECT_EQ(visibleFormFactor(x, n, polygon, {&surface, 1}), formFactor(x, n, polygon))
            << "trial " << trial;
        EXPECT_GT(formFactor(x, n, polygon), 0.1);
    }
}

TEST(ConeSubtraction, TrianglesBehindOrInTheLightsPlaneChangeNothing) {
    for (const double z : {2.0, 2.0 + 1e-12, 2.5, 100.0}) {
        const Triangle t = {dvec3(-5, -5, z), dvec3(5, -5, z), dvec3(0, 5, z)};
        EXPECT_EQ(visible(inPenumbra, {t}), whole(inPenumbra)) << "z " << z;
    }
    // The light's own two triangles, wherever the rounding of the positions leaves them.
    for (const double offset : {0.1, 1e3 / 3.0, 1e6 / 7.0}) {
        std::vector<dvec3> moved = light;
        for (dvec3& p : moved) p += dvec3(offset, -offset, offset);
        const dvec3 x = inPenumbra + dvec3(offset, -offset, offset);
        const std::vector<Triangle> itself = {{moved[0], moved[1], moved[2]}, {moved[0], moved[2], moved[3]}};
        EXPECT_EQ(visibleFormFactor(x, up, moved, itself), formFactor(x, up, moved)) << "offset " << offset;
    }
}

TEST(ConeSubtraction, TrianglesBelowTheReceiverChangeNothing) {
    EXPECT_EQ(visible(inPenumbra, {{dvec3(-9, -9, -1), dvec3(9, -9, -1), dvec3(0, 9, -1)}}),
              whole(inPenumbra));
    EXPECT_EQ(visible(inPenumbra, {{dvec3(-9, -9, -0.1), dvec3(9, -9, -2), dvec3(0, 9, -1)}}),
              whole(inPenumbra));
}

// --- What must be exactly dark.

TEST(ConeSubtraction, OneTriangleOverTheLightIsExactlyDark) {
    for (const double z : {1e-9, 0.01, 1.0, 1.99, 2.0 - 1e-9}) {
        const Triangle cover = {dvec3(-20, -20, z), dvec3(20, -20, z), dvec3(0, 40, z)};
        for (const dvec3& x : {dvec3(0, 0, 0), inPenumbra, dvec3(-0.9, 0.9, 0)}) {
            EXPECT_EQ(visible(x, {cover}), 0.0) << "z " << z;
            EXPECT_EQ(visible(x, {triangle, cover}), 0.0);
            EXPECT_EQ(visible(x, {{cover[2], cover[1], cover[0]}}), 0.0) << "the other winding";
        }
    }
}

TEST(ConeSubtraction, TwoTrianglesWithACommonDiagonalLeaveNoCrack) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int trial = 0; trial < 20000; ++trial) {
        const dvec3 x(uniform(random), uniform(random), 0);
        const dvec3 a(-4 + uniform(random), uniform(random), 1 + 0.4 * uniform(random));
        const dvec3 b(4 + uniform(random), uniform(random), 1 + 0.4 * uniform(random));
        const Triangle one = {a, b, dvec3(uniform(random), 9, 1.2)};
        const Triangle other = {b, a, dvec3(uniform(random), -9, 0.8)};
        EXPECT_LE(visible(x, {one, other}), 1e-15);
    }
}

// --- Clipping of the occluder: each case against sampling.

struct SampledCase {
    const char* name;
    dvec3 x, n;
    std::vector<Triangle> occluders;
};

const std::vector<SampledCase> sampledCases = {
    {"figure 2", {0.5, 0, 0}, up, {triangle}},
    {"light straddles the horizon", {0.4, 0.1, 0}, glm::normalize(dvec3(1, 0.1, 0.25)), {triangle}},
    {"occluder straddles the horizon",
     {0.2, 0.1, 0},
     up,
     {{dvec3(-1, -1, -1), dvec3(0.5, 0.2, 1.5), dvec3(0.2, 0.9, 1)}}},
    {"occluder straddles the light's plane",
     {0.2, 0.1, 0},
     up,
     {{dvec3(-0.3, -0.8, 1), dvec3(0.4, -0.1, 2.7), dvec3(0.1, 0.6, 3)}}},
    {"one vertex behind the light",
     {-0.2, 0.1, 0},
     up,
     {{dvec3(-0.3, -0.8, 1), dvec3(0.4, -0.1, 1.5), dvec3(0.1, 0.6, 3)}}},
    {"occluder touches the receiver",
     {0.1, 0.3, 0},
     up,
     {{dvec3(-0.5, 0, 0), dvec3(0.6, -0.2, 0), dvec3(0.1, 0, 1.7)}}},
    {"occluder beside x crosses its level",
     {0, 0, 0},
     up,
     {{dvec3(0.1, -1, -0.5), dvec3(0.1, 1, -0.5), dvec3(0.15, 0, 1)}}},
    {"overlapping triangles",
     {0.1, 0, 0},
     up,
     {triangle,
      {dvec3(-0.1, -0.5, 0.8), dvec3(0.5, 0.1, 1.2), dvec3(-0.2, 0.3, 1)},
      {dvec3(0, -0.6, 1.4), dvec3(0.1, 0.8, 0.5), dvec3(-0.1, 0.8, 0.5)}}}};

TEST(ConeSubtraction, AgreesWithSampling) {
    double squares = 0.0;
    for (const SampledCase& c : sampledCases) {
        const double exact = visibleFormFactor(c.x, c.n, light, c.occluders);
        const double sampled = sampledFormFactor(c.x, c.n, light, c.occluders, 1000);
        EXPECT_NEAR(exact, sampled, 3e-6) << c.name;
        EXPECT_LT(exact, formFactor(c.x, c.n, light) - 1e-4)
            << c.name << ": casts no shadow, the case tests nothing";
        EXPECT_GT(exact, 1e-4) << c.name;
        squares += (exact - sampled) * (exact - sampled);
    }
    EXPECT_LT(std::sqrt(squares / double(sampledCases.size())), 1e-6);
}

// --- A second exact method: occluders parallel to the light project to a polygon on it, whose Lambert
// formula is subtracted.

TEST(ConeSubtraction, AgreesWithPolygonDifferenceOnTheLight) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    double worst = 0.0;
    int partial = 0;
    for (int trial = 0; trial < 50000; ++trial) {
        const dvec3 x(1.2 * uniform(random), 1.2 * uniform(random), 0);
        const double z = 1.0 + 0.95 * uniform(random);
        Triangle t;
        for (dvec3& p : t) p = {uniform(random), uniform(random), z};
        const dvec3 n = glm::normalize(dvec3(0.3 * uniform(random), 0.3 * uniform(random), 1));
        const double value = visibleFormFactor(x, n, light, {&t, 1});
        const double exact = polygonDifferenceFormFactor(x, n, light, t);
        worst = std::max(worst, std::abs(value - exact));
        const double full = formFactor(x, n, light);
        partial += value > 0.0 && value < full ? 1 : 0;
    }
    EXPECT_LT(worst, 1e-14);
    EXPECT_GT(partial, 10000);
}

// --- A million random scenes, and those that are hardest.

/// What went wrong in random scenes: each is asked for once with its occluders, and once with the same
/// occluders cut in three. What lies between the two answers is a crack.
struct Findings {
    double worstCrack = 0.0;
    int notFinite = 0, negative = 0, aboveWhole = 0, penumbra = 0;

    void ask(const dvec3& x, const dvec3& n, std::span<const dvec3> polygon,
             const std::vector<Triangle>& occluders, const std::vector<Triangle>& inThree) {
        const double full = formFactor(x, n, polygon);
        const double value = visibleFormFactor(x, n, polygon, occluders);
        const double split = visibleFormFactor(x, n, polygon, inThree);
        notFinite += std::isfinite(value) && std::isfinite(full) && std::isfinite(split) ? 0 : 1;
        negative += value < 0.0 || split < 0.0 || full < 0.0 ? 1 : 0;
        aboveWhole += value > full || split > full || full > 1.0 ? 1 : 0;
        penumbra += value > 0.0 && value < full ? 1 : 0;
        worstCrack = std::max(worstCrack, std::abs(value - split));
    }
    void expectNone() const {
        EXPECT_EQ(notFinite, 0);
        EXPECT_EQ(negative, 0);
        EXPECT_EQ(aboveWhole, 0);
        EXPECT_LE(worstCrack, 1e-14);
    }
};

void appendInThree(const Triangle& t, const dvec3& middle, std::vector<Triangle>& inThree) {
    inThree.push_back({t[0], t[1], middle});
    inThree.push_back({t[1], t[2], middle});
    inThree.push_back({t[2], t[0], middle});
}

TEST(ConeSubtraction, AMillionRandomScenes) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto point = [&] { return dvec3(uniform(random), uniform(random), uniform(random)); };
    Findings findings;
    std::vector<Triangle> occluders, inThree;
    for (int trial = 0; trial < 1000000; ++trial) {
        const dvec3 x = point(), corner = 2.0 * point(), u = point(), v = point();
        const dvec3 polygon[] = {corner, corner + u, corner + u + v, corner + v};
        const dvec3 n = trial % 4 == 0 ? up : glm::normalize(point());
        occluders.clear();
        inThree.clear();
        for (int i = 0; i <= trial % 3; ++i) {
            Triangle t = {point(), point(), point()};
            for (dvec3& p : t) p = x + 0.7 * p + 0.5 * (corner + 0.5 * (u + v) - x);
            if (trial % 16 == 5) t[0].z = x.z;               // touches the receiver's level
            if (trial % 16 == 6) t[1] = polygon[1];          // touches the light
            if (trial % 16 == 7) t[2] = t[1] + 1e-9 * t[0];  // a needle
            occluders.push_back(t);
            appendInThree(t, 0.3 * t[0] + 0.45 * t[1] + 0.25 * t[2], inThree);
        }
        findings.ask(x, n, polygon, occluders, inThree);
    }
    findings.expectNone();
    EXPECT_GT(findings.penumbra, 100000);
}

// So near to the light that its edges are seen over nearly 180 degrees. Everything that could be a thousand
// times worse than a rounding error is: crossings computed from far corners, planes of edges and triangles,
// Lambert's formula. All coordinates are multiples of 2^-30, so that the three parts of a triangle lie in its
// plane exactly: else an ulp of the middle alone, seen from a height h, makes a true difference of an ulp /
// h.
TEST(ConeSubtraction, NoCracksHoweverNearTheLight) {
    std::mt19937 random(16);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto snap = [](const dvec3& p) { return glm::round(p * 0x1p30) * 0x1p-30; };
    const auto point = [&] { return snap(dvec3(uniform(random), uniform(random), uniform(random))); };
    Findings findings;
    std::vector<Triangle> occluders, inThree;
    for (int trial = 0; trial < 150000; ++trial) {
        const dvec3 corner = 2.0 * point(), u = point(), v = point();
        const dvec3 polygon[] = {corner, corner + u, corner + u + v, corner + v};
        const double height = 0.01 * std::exp2(-12.0 * std::abs(uniform(random)));
        const dvec3 inThePlane =
            corner + (0.5 + 0.7 * uniform(random)) * u + (0.5 + 0.7 * uniform(random)) * v;
        const dvec3 x = snap(inThePlane + height * glm::normalize(glm::cross(u, v)));
        const dvec3 n = glm::normalize(point());
        occluders.clear();
        inThree.clear();
        for (int i = 0; i <= trial % 3; ++i) {
            Triangle t = {point(), point(), point()};
            for (dvec3& p : t) p = snap(x + (trial % 2 == 0 ? 0.7 : 10.0 * height) * p);
            occluders.push_back(t);
            appendInThree(t, t[0] + 0.25 * (t[1] - t[0]) + 0.5 * (t[2] - t[0]), inThree);
        }
        findings.ask(x, n, polygon, occluders, inThree);
    }
    findings.expectNone();
    EXPECT_GT(findings.penumbra, 30000);
}

TEST(ConeSubtraction, TheOrderOfOccludersDoesNotMatter) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Triangle> soup(200);
    for (Triangle& t : soup) {
        const dvec3 centre(0.7 * uniform(random), 0.7 * uniform(random), 1 + 0.5 * uniform(random));
        for (dvec3& p : t) p = centre + 0.1 * dvec3(uniform(random), uniform(random), uniform(random));
    }
    const double value = visible(inPenumbra, soup);
    EXPECT_GT(value, 0.1 * whole(inPenumbra));
    EXPECT_LT(value, 0.9 * whole(inPenumbra));
    for (int trial = 0; trial < 5; ++trial) {
        std::shuffle(soup.begin(), soup.end(), random);
        EXPECT_NEAR(visible(inPenumbra, soup), value, 1e-14);
    }
}

// Two planes of each of 10 cones round off one corner of a 10-gon: its middle piece ends with 30 corners,
// more than a polygon holds.
TEST(ConeSubtraction, PiecesMayGrowManyCorners) {
    constexpr int corners = 10;
    const dvec3 x(0.1, 0.05, 0), middle(0, 0, 2);
    const auto direction = [](double angle) { return dvec3(std::cos(angle), std::sin(angle), 0); };
    std::vector<dvec3> polygon;
    std::vector<Triangle> slivers;
    for (int i = 0; i < corners; ++i) {
        const double angle = -2.0 * 3.14159265358979324 * i / corners;
        polygon.push_back(middle + 0.5 * direction(angle));
        const dvec3 apex = middle + 0.4906 * direction(angle);
        Triangle t = {apex + 0.2 * direction(angle + 1.52), apex, apex + 0.2 * direction(angle + 1.62)};
        for (dvec3& p : t) p = 0.5 * (p + x);
        slivers.push_back(t);
    }
    double fan = 0.0;
    for (int i = 0; i < corners; ++i) {
        const dvec3 part[] = {middle, polygon[std::size_t(i)], polygon[std::size_t((i + 1) % corners)]};
        fan += visibleFormFactor(x, up, part, slivers);
    }
    EXPECT_NEAR(visibleFormFactor(x, up, polygon, slivers), fan, 1e-15);
    EXPECT_LT(fan, formFactor(x, up, polygon) - 1e-6);
}

// Many occluders are dealt with part by part of the light; by how many parts must not matter.
TEST(ConeSubtraction, APatchworkOfLightsIsTheLight) {
    std::mt19937 random(15);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Triangle> soup(600);
    for (Triangle& t : soup) {
        const dvec3 centre(0.7 * uniform(random), 0.7 * uniform(random), 1 + 0.5 * uniform(random));
        for (dvec3& p : t) p = centre + 0.05 * dvec3(uniform(random), uniform(random), uniform(random));
    }
    const double value = visible(inPenumbra, soup);
    constexpr int patches = 24;
    double sum = 0.0;
    for (int j = 0; j < patches; ++j)
        for (int i = 0; i < patches; ++i) {
            const double left = double(i) / patches - 0.5, right = double(i + 1) / patches - 0.5;
            const double lower = double(j) / patches - 0.5, upper = double(j + 1) / patches - 0.5;
            const dvec3 patch[] = {{left, lower, 2}, {left, upper, 2}, {right, upper, 2}, {right, lower, 2}};
            sum += visibleFormFactor(inPenumbra, up, patch, soup);
        }
    EXPECT_NEAR(sum, value, 1e-14);
    EXPECT_GT(value, 0.1 * whole(inPenumbra));
    EXPECT_LT(value, 0.9 * whole(inPenumbra));
}

TEST(ConeSubtraction, AtACornerOfAStandingTriangleTheValueIsALimit) {
    // From the corner the triangle is seen edge-on. A hair away it hides more or less, depending on the side.
    const Triangle standing = {dvec3(0, 0, 0), dvec3(0.5, 0.1, 1), dvec3(-0.3, 0.4, 1)};
    const double at = visible({0, 0, 0}, {standing});
    double least = 1.0, most = 0.0;
    const dvec3 inItsPlane = glm::normalize(glm::cross(glm::cross(standing[1], standing[2]), up));
    const dvec3 across = glm::cross(up, inItsPlane);
    for (int i = 0; i < 64; ++i) {
        const double angle = 0.0981747704246810387 * i;
        const double near =
            visible(1e-9 * (std::cos(angle) * inItsPlane + std::sin(angle) * across), {standing});
        least = std::min(least, near);
        most = std::max(most, near);
    }
    EXPECT_GE(at, least - 1e-8);
    EXPECT_LE(at, most + 1e-8);
    EXPECT_LT(least, 0.5 * most);
}

// --- Culling against the pyramid.

TEST(LightPyramid, ABoxIsOutsideOnlyIfNothingInItCouldShadow) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const LightPyramid pyramid = lightPyramid(inPenumbra, up, light);
    int culled = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Aabb box;
        Triangle t;
        const dvec3 centre(1.5 * uniform(random), 1.5 * uniform(random), 1.0 + 2.0 * uniform(random));
        for (dvec3& p : t) {
            p = centre + 0.3 * dvec3(uniform(random), uniform(random), uniform(random));
            box.extend(p);
        }
        const bool isOutside = outside(pyramid, box);
        culled += isOutside ? 1 : 0;
        if (isOutside) {
            EXPECT_EQ(visible(inPenumbra, {t}), whole(inPenumbra));
        }
    }
    EXPECT_GT(culled, 10000);
}

}  // namespace
}  // namespace penumbra
