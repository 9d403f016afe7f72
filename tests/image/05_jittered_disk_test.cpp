// Chapter 05 against the truth. The chapter's own class is tested, so its main.cpp is part of this file.
#define main chapterMain
#include "chapters/05_jittered_disk/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/truth/edge_coverage.h"
#include "tests/image/bias_scenes.h"
#include "tests/image/earlier_chapters.h"
#include "tests/image/edge_scene.h"
#include "tests/image/image_check.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(192, 192);

std::unique_ptr<Chapter> chapter() {
    return std::make_unique<JitteredDisk>();
}

// --- a radius of nothing is one test ---

TEST(Chapter05, RadiusZeroIsChapter02WithoutBiasAndChapter03WithIt) {
    for (const std::string& name : testScenes()) {
        ChapterHarness harness(chapter(), testScene(name));
        const std::string folder = "05_jittered_disk/" + shortName(name);
        harness.set("radius", "0");
        for (const bool plane : {false, true}) {
            harness.set("receiver-plane", plane ? "true" : "false");
            const BiasMethod method = plane ? BiasMethod::receiverPlane : BiasMethod::slope;
            const FloatImage exact = visibilityOfChapter03(harness, size, method);
            expectImage(folder + (plane ? "/radius_0_plane" : "/radius_0_slope"),
                        harness.scalar("visibility", size), exact, {}, {.maxAbs = 0.0});
        }
        harness.set("receiver-plane", "false");
        harness.set("bias", "0");
        const FloatImage exact = visibilityOfChapter02(harness, size);
        expectImage(folder + "/radius_0_no_bias", harness.scalar("visibility", size), exact, {},
                    {.maxAbs = 0.0});
    }
}

// --- one pattern for all pixels ---

/// What the pattern says of the texels that an edge along them leaves lit, tap by tap in double.
FloatImage tapByTap(const EdgeScene& edge, const std::vector<glm::dvec2>& points, double radius, int pixels) {
    FloatImage exact(pixels, pixels, 1);
    const int axis = std::abs(edge.normal().x) > std::abs(edge.normal().y) ? 0 : 1;
    for (int y = 0; y < pixels; ++y) {
        for (int x = 0; x < pixels; ++x) {
            // To the edge of the dark texels, which is a whole number of texels from their corners.
            const double d = edge.texelisedDistance(x, y, pixels);
            const auto lit = [&](const glm::dvec2& p) {
                return d + edge.normal()[axis] * radius * p[axis] > 0.0;
            };
            exact.at(x, y) = float(std::count_if(points.begin(), points.end(), lit)) / float(points.size());
        }
    }
    return exact;
}

TEST(Chapter05, EveryPixelAsksThePatternOfTheSeed) {
    const glm::dvec2 angles(0.0, 1.5707963267948966);
    for (const auto& pattern : squarePatternNames()) {
        for (const auto& map : diskMapNames()) {
            for (int i = 0; i < 2; ++i) {
                const EdgeScene edge(angles[i], 32);
                ChapterHarness harness(chapter(), edge.scene);
                harness.set("map-size", "32");
                harness.set("radius", "4.3");
                harness.set("samples", "13");
                harness.set("pattern", pattern);
                harness.set("disk-map", map);
                const auto points = diskPattern(squarePattern(pattern), diskMap(map), 13, 0);
                const FloatImage actual = harness.scalar("visibility", glm::ivec2(128));
                // A tap on the very border of a texel may be rounded either way: one of 13, in a row of
                // pixels.
                expectImage("05_jittered_disk/taps/" + pattern + "_" + map + (i ? "_t" : "_s"), actual,
                            tapByTap(edge, points, 4.3, 128), {}, {.meanAbs = 1e-3});
                const std::set<float> levels(actual.values.begin(), actual.values.end());
                EXPECT_LE(levels.size(), 14u) << "bands, not noise";
            }
        }
    }
}

// --- the limit ---

struct EdgeError {
    double meanAbs = 0, bias = 0;
};

/// Over the pixels whose disk the edge crosses.
EdgeError errorOfEdge(double angle, double radius) {
    EdgeError error;
    double pixels = 0;
    for (int phase = 0; phase < 4; ++phase) {
        const EdgeScene edge(angle, 32, (phase + 0.37) / 4);
        ChapterHarness harness(chapter(), edge.scene);
        harness.set("map-size", "32");
        harness.set("radius", std::to_string(radius));
        harness.set("samples", "1024");
        const FloatImage actual = harness.scalar("visibility", glm::ivec2(128));
        for (int y = 0; y < 128; ++y) {
            for (int x = 0; x < 128; ++x) {
                const double d = edge.distance(x, y, 128);
                if (std::abs(d) >= radius || edge.inside(x, y, 128) < radius + 1.0) continue;
                const double difference = actual.at(x, y) - diskCoverage(d, radius);
                error.meanAbs += std::abs(difference);
                error.bias += difference;
                ++pixels;
            }
        }
    }
    return {error.meanAbs / pixels, error.bias / pixels};
}

/// The texels of an edge are off by an area of c/4 + s^2/(12c) for each unit of its length, and a disk holds
/// at most 2r of it: 2 (c/4 + s^2/(12c)) / (pi r), which is 0.155/r averaged over directions. 1024 samples
/// add 0.0022.
double limitOfEdge(double angle, double radius) {
    const double c = std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    const double s = std::min(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    return 2.0 * (c / 4.0 + s * s / (12.0 * c)) / (3.141592653589793 * radius) + 0.0022;
}

TEST(Chapter05Slow, EdgesAreTheDisksUpToTheTexels) {
    for (const double radius : {2.0, 4.0, 7.0}) {
        for (int k = 0; k < 8; ++k) {
            const double angle = 3.141592653589793 * k / 8.0;
            const EdgeError error = errorOfEdge(angle, radius);
            EXPECT_LT(error.meanAbs, limitOfEdge(angle, radius)) << radius << " texels, edge " << k;
            // Of the mean over four phases an eighth of a texel may be left; the profile rises by 2/(pi r) a
            // texel.
            EXPECT_LT(std::abs(error.bias), 0.125 * 2.0 / (3.14159 * radius)) << radius << ", edge " << k;
        }
    }
    EXPECT_GT(errorOfEdge(0.0, 4.0).meanAbs, 0.5 * limitOfEdge(0.0, 4.0)) << "a loose limit";
}

// --- scenes ---

double rmseOf(ChapterHarness& harness) {
    const TruthImage truth = harness.truth("visibility", size);
    return compareImages(harness.scalar("visibility", size), truth.value, truth.mask).rmse;
}

class AgainstTruth : public testing::TestWithParam<std::string> {};

/// Measured with 256 samples 0.0023, 0.0038 and 0.0082, with a third of reserve: texels, then samples. The
/// engine's fins are slivers, which turn over when the rasteriser snaps their corners.
ImageBounds errorBounds(const std::string& scene) {
    if (scene == thirdPartyModel) return {.meanAbs = 0.02, .absBias = 0.003};
    if (scene == "courtyard") return {.rmse = 0.011, .absBias = 0.001};
    return {.rmse = scene == "contact" ? 0.0051 : 0.0031, .absBias = 0.0006};
}

TEST_P(AgainstTruth, TheFiltersLimit) {
    ChapterHarness harness(chapter(), testScene(GetParam()));
    harness.set("samples", "256");
    const TruthImage truth = harness.truth("visibility", size);
    EXPECT_EQ(truth.against, "filter");
    expectImage("05_jittered_disk/" + shortName(GetParam()) + "/visibility",
                harness.scalar("visibility", size), truth.value, truth.mask, errorBounds(GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Chapter05, AgainstTruth, testing::ValuesIn(testScenes()), sceneTestName);

TEST(Chapter05, MoreSamplesHelpUnlessTheMapIsWrong) {
    const auto rmse = [](const char* map, const char* samples) {
        ChapterHarness harness(chapter(), testScene("heckbert_herf"));
        harness.set("radius", "16");
        harness.set("disk-map", map);
        harness.set("samples", samples);
        return rmseOf(harness);
    };
    EXPECT_LT(rmse("polar", "256"), 0.4 * rmse("polar", "16"));
    EXPECT_GT(rmse("polar-linear", "1024"), 3.0 * rmse("polar", "1024"));
}

TEST(Chapter05, TheAreaLightIsSomethingElse) {
    ChapterHarness harness(chapter(), testScene("heckbert_herf"));
    const auto area = harness.areaLightTruth("visibility", size);
    ASSERT_TRUE(area);
    const FloatImage actual = harness.scalar("visibility", size);
    EXPECT_GT(compareImages(actual, area->value, area->mask).rmse, 10.0 * rmseOf(harness));
}

AcneCount acneOnPlanes(const std::string& bias, const std::string& radius, const std::string& plane) {
    constexpr int planes = 12;
    constexpr LightType types[] = {LightType::spot, LightType::point, LightType::directional};
    AcneCount total;
    for (int i = 0; i < planes; ++i) {
        std::mt19937 random(3000 + i);
        const Scene scene = tiltedPlane(85.0 * radiansPerDegree * i / (planes - 1), types[i % 3], random);
        ChapterHarness harness(chapter(), scene);
        harness.set("samples", "64");
        harness.set("radius", radius);
        harness.set("receiver-plane", plane);
        harness.set("bias", bias);
        harness.set("map-size", std::to_string(128 << (i % 3)));
        total += countAcne(harness, 128, 0.999f);
    }
    return total;
}

TEST(Chapter05, NoAcneUpTo85Degrees) {
    for (const char* radius : {"0", "1.5", "8", "24"}) {
        for (const char* plane : {"false", "true"}) {
            const AcneCount count = acneOnPlanes("1", radius, plane);
            EXPECT_GT(count.receivers, 80000u);
            EXPECT_EQ(count.dark, 0u) << radius << " texels, plane " << plane;
        }
    }
    EXPECT_GT(acneOnPlanes("0.85", "8", "false").dark, 500u) << "the bound is not tight";
}

TEST(Chapter05, SkippingChangesNoBit) {
    for (const std::string& name : testScenes()) {
        ChapterHarness harness(chapter(), testScene(name));
        const FloatImage skipped = harness.picture("color", size, 3);
        EXPECT_EQ(harness.work["tests_per_pixel"], 16);
        harness.skip = false;
        expectImage("05_jittered_disk/" + shortName(name) + "/skip", harness.picture("color", size, 3),
                    skipped, {}, {.maxAbs = 0.0});
    }
}

TEST(Chapter05, EsShowsTheSamePicture) {
    FloatImage pictures[2];
    for (const Api api : {Api::desktop, Api::es}) {
        ChapterHarness harness(chapter(), testScene("contact"), api);
        pictures[api == Api::es] = harness.scalar("visibility", size);
    }
    expectImage("05_jittered_disk/contact/es", pictures[1], pictures[0], {}, {.meanAbs = 1e-3});
}

/// Each broken shader must break a bound that the true one keeps.
TEST(Chapter05, ABrokenShaderIsCaught) {
    const std::string disk = "05_jittered_disk/disk.glsl";
    const auto keepsBounds = [] {
        const EdgeScene edge(0.0, 32);
        ChapterHarness harness(chapter(), edge.scene);
        harness.set("map-size", "32");
        harness.set("radius", "4.3");
        harness.set("samples", "13");
        const auto points = diskPattern(SquarePattern::jittered, DiskMap::concentric, 13, 0);
        const FloatImage actual = harness.scalar("visibility", glm::ivec2(128));
        if (compareImages(actual, tapByTap(edge, points, 4.3, 128)).meanAbs > 1e-3) return false;
        if (errorOfEdge(0.4, 4.0).meanAbs > limitOfEdge(0.4, 4.0)) return false;
        return acneOnPlanes("1", "8", "false").dark == 0;
    };
    struct Mutation {
        const char* what;
        std::string from, to;
    };
    const Mutation mutations[] = {
        {"radius halved", "uRadius * patternOffset(i)", "0.5 * uRadius * patternOffset(i)"},
        {"pattern mirrored", "ivec2(index, 0), 0).xy", "ivec2(index, 0), 0).yx"},
        {"first sample left out", "for (int i = 0;", "for (int i = 1;"},
        {"always the same sample", "patternOffset(i))", "patternOffset(0))"},
        {"bias of one tap", "return radius * slopePerTexel", "return 0.0 * slopePerTexel"},
    };
    EXPECT_TRUE(keepsBounds());
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(disk, m.from, m.to);
        EXPECT_FALSE(keepsBounds()) << m.what;
    }
}

}  // namespace
}  // namespace penumbra
