// Transforms against their definitions: where the planes of a frustum land, and slopes against finite steps
// on a plane.
#include "common/math/transforms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace penumbra {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 project(const glm::dmat4& m, const glm::dvec3& p) {
    const glm::dvec4 h = m * glm::dvec4(p, 1.0);
    return glm::dvec3(h) / h.w;
}

double depthAt(const glm::dmat4& clipFromView, double distance) {
    return project(clipFromView, {0, 0, -distance}).z;
}

TEST(Perspective, NearAndFarLandOnTheEndsOfTheRange) {
    for (const double far : {0.11, 10.0, 1e9}) {
        const glm::dmat4 standard = perspective(0.8, 1.5, 0.1, far);
        EXPECT_NEAR(depthAt(standard, 0.1), -1.0, 1e-14);
        EXPECT_NEAR(depthAt(standard, far), 1.0, 1e-14);
        const glm::dmat4 reversed = perspective(0.8, 1.5, 0.1, far, DepthRange::reversed);
        EXPECT_NEAR(depthAt(reversed, 0.1), 1.0, 1e-14);
        EXPECT_NEAR(depthAt(reversed, far), 0.0, 1e-14);
    }
}

TEST(Perspective, InfiniteFarIsTheLimitOfALargeFar) {
    const glm::dmat4 standard = perspective(0.8, 1.5, 0.1, infinity);
    EXPECT_NEAR(depthAt(standard, 0.1), -1.0, 1e-15);
    EXPECT_NEAR(depthAt(standard, 1e12), 1.0, 1e-12);
    const glm::dmat4 reversed = perspective(0.8, 1.5, 0.1, infinity, DepthRange::reversed);
    EXPECT_NEAR(depthAt(reversed, 0.1), 1.0, 1e-15);
    EXPECT_NEAR(depthAt(reversed, 1e12), 0.1 / 1e12, 1e-27);
}

TEST(Perspective, FieldOfViewIsVerticalAndAspectWidensIt) {
    const double fov = 0.9;
    const double halfHeight = 3.0 * std::tan(0.5 * fov);
    const glm::dvec3 corner = project(perspective(fov, 2.0, 0.1, 9.0), {2.0 * halfHeight, halfHeight, -3.0});
    EXPECT_NEAR(corner.x, 1.0, 1e-14);
    EXPECT_NEAR(corner.y, 1.0, 1e-14);
}

TEST(Perspective, CloseNearAndFarKeepTheirPrecision) {
    const double near = 1.0;
    const double far = 1.0 + 1e-9;
    EXPECT_NEAR(depthAt(perspective(0.8, 1.0, near, far), 0.5 * (near + far)), 0.0, 1e-6);
}

TEST(Orthographic, BoxLandsOnTheCube) {
    const glm::dmat4 standard = orthographic(-2, 4, 1, 7, 3, 11);
    const glm::dvec3 low = project(standard, {-2, 1, -3});
    const glm::dvec3 high = project(standard, {4, 7, -11});
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(low[i], -1.0, 1e-15);
        EXPECT_NEAR(high[i], 1.0, 1e-15);
    }
    const glm::dmat4 reversed = orthographic(-2, 4, 1, 7, 3, 11, DepthRange::reversed);
    EXPECT_NEAR(project(reversed, {0, 2, -3}).z, 1.0, 1e-15);
    EXPECT_NEAR(project(reversed, {0, 2, -11}).z, 0.0, 1e-15);
}

TEST(ViewFromWorld, LooksAlongMinusZWithUpAbove) {
    const glm::dvec3 eye(3, 4, 5);
    const glm::dmat4 view = viewFromWorld(eye, {2, 0, 0});
    EXPECT_LT(glm::length(project(view, eye)), 1e-14);
    EXPECT_LT(glm::distance(project(view, eye + glm::dvec3(7, 0, 0)), glm::dvec3(0, 0, -7)), 1e-14);
    EXPECT_LT(glm::distance(project(view, eye + glm::dvec3(0, 2, 0)), glm::dvec3(0, 2, 0)), 1e-14);
    EXPECT_LT(glm::distance(project(view, eye + glm::dvec3(0, 0, 1)), glm::dvec3(1, 0, 0)), 1e-14);
}

TEST(ViewFromWorld, IsARotationEvenWhenUpIsParallelOrZero) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 forward(normal(random), normal(random), normal(random));
        for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), -3.0 * forward, forward + glm::dvec3(1e-9, 0, 0),
                                     forward + glm::dvec3(1e-5, 0, 0), glm::dvec3(0.0)}) {
            const glm::dmat3 r(viewFromWorld({1, 2, 3}, forward, up));
            const glm::dmat3 identity = r * glm::transpose(r);
            for (int c = 0; c < 3; ++c) {
                EXPECT_LT(glm::distance(identity[c], glm::dmat3(1.0)[c]), 1e-9);
            }
            EXPECT_NEAR(glm::determinant(r), 1.0, 1e-9);
        }
    }
}

TEST(TextureFromClip, MapsTheCubeToTheUnitCube) {
    EXPECT_EQ(project(textureFromClip(), {-1, -1, -1}), glm::dvec3(0, 0, 0));
    EXPECT_EQ(project(textureFromClip(), {1, 1, 1}), glm::dvec3(1, 1, 1));
    EXPECT_EQ(project(textureFromClip(DepthRange::reversed), {1, -1, 0.25}), glm::dvec3(1, 0, 0.25));
    // Before the division by w: the offset has to be multiplied by w.
    EXPECT_EQ(textureFromClip() * glm::dvec4(0, 0, 0, 4), glm::dvec4(2, 2, 2, 4));
}

/// Depth change between p and a point of the plane, compared with what the slope predicts for the same step
/// in u and v.
void expectSlopePredictsPlane(const glm::dmat4& textureFromWorld, const glm::dvec3& p, const glm::dvec3& n,
                              double step) {
    const glm::dvec3 t = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.8, -0.5)));
    const glm::dvec3 b = glm::cross(n, t);
    const glm::dvec2 slope = depthSlope(textureFromWorld, p, n);
    const glm::dvec3 at = project(textureFromWorld, p);
    for (const glm::dvec3& side : {p + step * t, p - step * b, p + step * (t + b)}) {
        const glm::dvec3 d = project(textureFromWorld, side) - at;
        const double scale = std::abs(slope.x * d.x) + std::abs(slope.y * d.y) + 1.0;
        EXPECT_NEAR(slope.x * d.x + slope.y * d.y, d.z, 1e-12 * scale);
    }
}

TEST(DepthSlope, IsExactOnPlanesUnderEveryProjection) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const glm::dvec3 eye(1, 6, 2);
    const glm::dmat4 view = viewFromWorld(eye, {0.2, -1, -0.4});
    for (const DepthRange range : {DepthRange::standard, DepthRange::reversed}) {
        for (const glm::dmat4& clipFromView :
             {perspective(1.0, 1.0, 1.0, 20.0, range), perspective(1.0, 1.0, 1.0, infinity, range),
              orthographic(-5, 5, -4, 6, 1, 20, range)}) {
            const glm::dmat4 textureFromWorld = textureFromClip(range) * clipFromView * view;
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 p = glm::dvec3(unit(random), unit(random), unit(random));
                const glm::dvec3 n = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
                // Not edge-on to the light: there the slope is infinite by nature, and tested below.
                if (std::abs(glm::dot(n, glm::normalize(eye - p))) < 0.05) continue;
                if (std::abs(glm::dot(n, glm::normalize(glm::dvec3(0.2, -1, -0.4)))) < 0.05) continue;
                expectSlopePredictsPlane(textureFromWorld, p, n, 0.5);
            }
        }
    }
}

TEST(DepthSlope, IsZeroFacingTheLightAndHugeEdgeOn) {
    const glm::dmat4 textureFromWorld =
        textureFromClip() * orthographic(-5, 5, -5, 5, 1, 20) * viewFromWorld({0, 10, 0}, {0, -1, 0});
    EXPECT_LT(glm::length(depthSlope(textureFromWorld, {0, 1, 0}, {0, 1, 0})), 1e-15);
    const glm::dvec2 edgeOn = depthSlope(textureFromWorld, {0, 1, 0}, {1, 0, 0});
    EXPECT_GT(std::max(std::abs(edgeOn.x), std::abs(edgeOn.y)), 1e12);
}

TEST(DepthSlope, IsTheSameAtEveryPointOfAPlane) {
    // Under perspective: an orthographic slope does not depend on the point at all. Rounding a point 500 km
    // away moves it off the plane by 6e-11 m; anything formed in float would be wrong from the eighth digit
    // on.
    const glm::dmat4 textureFromWorld =
        textureFromClip() * perspective(1.0, 1.0, 1.0, 20.0) * viewFromWorld({0, 10, 0}, {0.1, -1, 0.2});
    const glm::dvec3 n(0.6, 0.8, 0.0), p(0.3, 1.1, 0.7);
    const glm::dvec2 nearby = depthSlope(textureFromWorld, p, n);
    for (const glm::dvec3& along : {glm::dvec3(4, -3, 0), glm::dvec3(0, 0, 5), glm::dvec3(-4, 3, 2)}) {
        const glm::dvec2 farAway = depthSlope(textureFromWorld, p + 1e5 * along, n);
        EXPECT_LT(glm::distance(nearby, farAway), 1e-9 * glm::length(nearby));
    }
}

}  // namespace
}  // namespace penumbra
