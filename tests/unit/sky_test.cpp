// Skies, and where no ray is needed to know that all of one is seen.
#include "chapters/09_ambient_occlusion/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "chapters/09_ambient_occlusion/open_planes.h"
#include "common/error.h"
#include "common/image/image_file.h"
#include "tests/image/lit_scenes.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

using glm::dvec3;
constexpr double infinite = std::numeric_limits<double>::infinity();

double largest(const dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST(Sky, OvercastIsThreeTimesAsBrightAboveAsAtTheHorizon) {
    const Sky sky = Sky::overcast({3, 6, 9});
    EXPECT_EQ(sky.radiance({0, 1, 0}), dvec3(3, 6, 9));
    EXPECT_LE(largest(sky.radiance({1, 1e-9, 0}) - dvec3(1, 2, 3)), 1e-8);
    EXPECT_EQ(sky.radiance({0.6, -0.8, 0}), dvec3(0.0));
    // E = 7 pi zenith / 9. The sum over cells of equal weight errs by less than a cell of 1/128, squared.
    EXPECT_LE(largest(sky.onOpenGround() - dvec3(3, 6, 9) * (7.0 / 9.0)), 1e-3);
}

TEST(Sky, LinearIsMeanAndGradient) {
    const glm::dmat3 gradient(dvec3(1, 2, 3), dvec3(4, 5, 6), dvec3(7, 8, 9));  // columns: x, y, z
    const Sky sky = Sky::linear({0.5, 0.25, 0.125}, gradient);
    EXPECT_EQ(sky.radiance({1, 0, 0}), dvec3(1.5, 2.25, 3.125));
    EXPECT_EQ(sky.radiance({0, 0, -1}), dvec3(0.5, 0.25, 0.125) - dvec3(7, 8, 9));
    // 1/pi int (a + g.w)(n.w) dw = a + 2/3 g.n
    EXPECT_LE(largest(sky.onOpenGround() - (dvec3(0.5, 0.25, 0.125) + 2.0 / 3.0 * dvec3(4, 5, 6))), 1e-3);
}

TEST(Sky, HalvesAddUpToTheWhole) {
    const Sky sky = Sky::overcast({1, 1, 1}).times(2.0);
    const Sky east = sky.onlySide({1, 0, 0}), west = sky.onlySide({-1, 0, 0});
    EXPECT_EQ(east.radiance(glm::normalize(dvec3(-0.1, 1, 0))), dvec3(0.0));
    EXPECT_GT(east.radiance(glm::normalize(dvec3(0.1, 1, 0))).x, 1.9);
    EXPECT_LE(largest(east.onOpenGround() + west.onOpenGround() - sky.onOpenGround()), 1e-12);
}

// Four columns look along +z (0), -x (1), ... : column u = 0.5, between the second and the third, is -z.
TEST(Sky, APictureIsTheRightWayRound) {
    FloatImage picture(4, 3, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) picture.at(x, y, 0) = float(10 * y + x);
    const Sky sky = Sky::latLong(picture);
    const double s = std::sqrt(0.5);
    const auto at = [&](const dvec3& direction) { return sky.radiance(direction).x; };
    // Texel centres: u = 1/8 (behind, left), 3/8 (ahead, left), 5/8 (ahead, right), 7/8 (behind, right).
    EXPECT_NEAR(at({-s, 0, s}), 10.0, 1e-6);
    EXPECT_NEAR(at({-s, 0, -s}), 11.0, 1e-6);
    EXPECT_NEAR(at({s, 0, -s}), 12.0, 1e-6);
    EXPECT_NEAR(at({s, 0, s}), 13.0, 1e-6);
    EXPECT_NEAR(at({0, 0, -1}), 11.5, 1e-6) << "between two columns";
    EXPECT_NEAR(at({0, 0, 1}), 11.5, 1e-6) << "between the last column and the first";
    EXPECT_LT(at(glm::normalize(dvec3(s, 1, -s))), 12.0) << "the top row is up";
    EXPECT_GT(at(glm::normalize(dvec3(s, -1, -s))), 12.0);
    for (const double y : {1.0, -1.0}) EXPECT_TRUE(std::isfinite(at({0, y, 0})));
}

TEST(Sky, APictureOfOneTexelIsUniform) {
    const Sky sky = Sky::latLong(FloatImage(1, 1, 3, 2.0f));
    for (const dvec3& w :
         {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(0, 0, 1), dvec3(-0.6, 0, 0.8)})
        EXPECT_EQ(sky.radiance(w), dvec3(2.0));
}

TEST(Sky, WhatIsNoSkyIsRefused) {
    EXPECT_THROW(Sky::latLong({}), Error);
    EXPECT_THROW(Sky::latLong(FloatImage(2, 2, 1)), Error);
    EXPECT_THROW(Sky::latLong(FloatImage(2, 2, 3, -1.0f)), Error);
    EXPECT_THROW(Sky::latLong(FloatImage(2, 2, 3, std::numeric_limits<float>::quiet_NaN())), Error);
    EXPECT_THROW(Sky::latLong(FloatImage(2, 2, 3, std::numeric_limits<float>::infinity())), Error);
    try {
        Sky::named("overcst");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean overcast?"), std::string::npos);
    }
    const TemporaryFolder folder;
    writeTextFile(folder.path() / "broken.exr", "no picture");
    EXPECT_THROW(Sky::named((folder.path() / "broken.exr").string()), Error);
}

TEST(Sky, FilesOfAnyChannelsAreRead) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3, 4}) {
        const auto file = folder.path() / ("sky" + std::to_string(channels) + ".exr");
        FloatImage picture(8, 4, channels, 0.5f);
        if (channels == 4)
            for (std::size_t i = 0; i < 32; ++i) picture.values[4 * i + 3] = 9.0f;
        writeImage(file, picture);
        EXPECT_EQ(Sky::named(file.string()).radiance({0.6, 0.0, 0.8}), dvec3(0.5)) << channels;
    }
}

// --- rays into the sky -------------------------------------------------------------------------------------

/// What a ray straight down finds at (x, z).
Hit below(const RayTracer& tracer, double x, double z) {
    return tracer.nearest({{x, 20.0, z}, {0, -1, 0}});
}

// Where a wall stands on the floor half of the sky is hidden, however near the point is to it: rays that
// begin a little way off start beyond the wall, and light leaks in.
TEST(AmbientRays, ContactIsDark) {
    const Scene scene = floorScene().quad({-0.5, 0, 1}, {0, 900, 0}, {0, 0, -2}).take();
    const RayTracer tracer(scene);
    const Hit hit = below(tracer, -0.5 + 1e-4, 0.0);
    std::int64_t traced = 0;
    const AmbientValue value =
        estimateAmbient(tracer, hit, hit.shadingNormal, {1024, Weighting::cosine, {}}, 1, traced);
    EXPECT_NEAR(value.visibility, 0.5, 0.005);
}

// A shading normal may lean: what it sees of its own surface is no sky, and costs no ray. The hemisphere
// about a normal tilted by b shows (1 + cos b)/2 of itself above the surface.
TEST(AmbientRays, DirectionsBelowTheSurfaceAreBlockedAndCostNothing) {
    const Scene scene = floorScene().take();
    const RayTracer tracer(scene);
    const Hit hit = below(tracer, 0.1, 0.2);
    const double tilt = 1.0;
    std::int64_t traced = 0;
    const AmbientValue value = estimateAmbient(tracer, hit, {std::sin(tilt), std::cos(tilt), 0.0},
                                               {4096, Weighting::cosine, {}}, 1, traced);
    EXPECT_NEAR(value.visibility, 0.5 * (1.0 + std::cos(tilt)), 0.003);
    EXPECT_EQ(double(traced), 4096.0 * value.visibility);
}

TEST(AmbientRays, FalloffGoesFromBlockedToOpen) {
    const AmbientReach reach{2.0, true};
    EXPECT_EQ(openAt(0.0, reach), 0.0);
    EXPECT_EQ(openAt(1.0, reach), 0.75);
    EXPECT_EQ(openAt(2.0, reach), 1.0);
    EXPECT_EQ(openAt(9.0, reach), 1.0);
}

// --- where no ray is needed --------------------------------------------------------------------------------

TEST(OpenPlanes, OnlyWhatRisesAboveThePlaneWithinRangeCounts) {
    const Scene scene = floorScene().box({0.4, -0.5, 0.4}, {0.6, 0.3, 0.6}).take();
    const RayTracer tracer(scene);
    const OpenPlanes planes(scene);
    const Hit floor = below(tracer, 0.0, 0.5), top = below(tracer, 0.5, 0.5);
    ASSERT_TRUE(floor.valid && top.valid);
    EXPECT_FALSE(planes.nothingAbove(floor, infinite));
    EXPECT_FALSE(planes.nothingAbove(floor, 0.41)) << "0.4 m from the box";
    EXPECT_TRUE(planes.nothingAbove(floor, 0.39));
    EXPECT_TRUE(planes.nothingAbove(top, infinite)) << "all is below the top of the box";
    Hit back = floor;  // the floor from below: the box reaches through
    back.fromBehind = true;
    back.geometricNormal = -back.geometricNormal;
    EXPECT_FALSE(planes.nothingAbove(back, infinite));
    Hit inside = top;  // of the box, after its top was asked about
    inside.fromBehind = true;
    inside.geometricNormal = -inside.geometricNormal;
    EXPECT_FALSE(planes.nothingAbove(inside, infinite));
    EXPECT_TRUE(planes.nothingAbove(below(tracer, -0.9, -0.9), 0.5));

    // Of one cluster it is its triangles that count: a quad far up and one that is far away.
    std::vector<std::array<dvec3, 3>> far;
    for (const dvec3& corner : {dvec3(0, 9, 0), dvec3(3, 0, 0)})
        far.push_back({corner, corner + dvec3(0.1, 0, 0), corner + dvec3(0, 0.5, 0.1)});
    const Scene apart = floorScene().part(far, false).take();
    const RayTracer otherTracer(apart);
    const OpenPlanes otherPlanes(apart);
    EXPECT_TRUE(otherPlanes.nothingAbove(below(otherTracer, 0.9, -0.5), 1.5));
    EXPECT_FALSE(otherPlanes.nothingAbove(below(otherTracer, 0.9, -0.5), 2.5));
}

TEST(OpenPlanes, APlaneOfManyTrianglesInAnyDirectionIsOpen) {
    for (const double angle : {0.0, 0.3, 1.1}) {
        const Scene scene = turned(floorScene().quad({-0.5, -0.2, 0}, {0.4, 0, 0}, {0, 0, -0.4}).take(),
                                   {0.3, 0.5, 0.9}, angle);
        const RayTracer tracer(scene);
        const OpenPlanes planes(scene);
        int open = 0, asked = 0;
        for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
            const glm::dvec3 centre =
                (glm::dvec3(scene.positions[3 * triangle]) + glm::dvec3(scene.positions[3 * triangle + 1]) +
                 glm::dvec3(scene.positions[3 * triangle + 2])) /
                3.0;
            const glm::dvec3 n(scene.normals[3 * triangle]);
            const Hit hit = tracer.nearest({centre + n, -n});
            ASSERT_TRUE(hit.valid);
            ++asked;
            open += planes.nothingAbove(hit, infinite);
        }
        // Turned, the corners of the other triangle are rounded to float and may rise above the plane: then
        // rays are traced, which is right too. Level, nothing is rounded.
        if (angle == 0.0) {
            EXPECT_EQ(open, asked);
        }
    }
}

// The box of a tilted plane rises above it, and the plane does not. These corners are exact in float.
TEST(OpenPlanes, ItIsTrianglesThatCountAndNotTheirBoxes) {
    const Scene scene = SmallScene().quad({0, 0, 0}, {1, 1, 0}, {0, 0, -1}).take();
    const RayTracer tracer(scene);
    EXPECT_TRUE(OpenPlanes(scene).nothingAbove(below(tracer, 0.3, -0.6), infinite));
}

// The skip claims to be exact: the same to the bit, wherever it is taken.
TEST(OpenPlanes, WithoutRaysTheAnswerIsTheSame) {
    const Scene scene = turned(floorScene().box({0.4, -0.5, 0.4}, {0.6, 0.3, 0.6}).take(), {0, 0, 1}, 0.4);
    const RayTracer tracer(scene);
    const OpenPlanes planes(scene);
    int skipped = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec2 u = owenSobol(std::uint32_t(i), 5);
        const Hit hit = tracer.nearest({{3.0 * u.x - 1.5, 20.0, 2.0 * u.y - 1.0}, {0, -1, 0}});
        if (!hit.valid) continue;
        for (const double range : {0.25, infinite}) {
            if (!planes.nothingAbove(hit, range)) continue;
            ++skipped;
            AmbientRays rays{64, i % 2 ? Weighting::cosine : Weighting::uniform, {range, i % 3 == 0}};
            std::int64_t traced = 0, none = 0;
            const AmbientValue all =
                estimateAmbient(tracer, hit, hit.shadingNormal, rays, std::uint32_t(i), traced);
            rays.nothingAbove = true;
            const AmbientValue skip =
                estimateAmbient(tracer, hit, hit.shadingNormal, rays, std::uint32_t(i), none);
            EXPECT_EQ(all.visibility, skip.visibility);
            EXPECT_EQ(all.bent, skip.bent);
            EXPECT_EQ(traced, 64);
            EXPECT_EQ(none, 0);
        }
    }
    EXPECT_GT(skipped, 100);
}

}  // namespace
}  // namespace penumbra
