// Chapter 04 against the truth. The chapter's own class is tested, so its main.cpp is part of this file.
#define main chapterMain
#include "chapters/04_pcf/main.cpp"
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
    return std::make_unique<Pcf>();
}

// --- one tap is chapter 03 ---

TEST(Chapter04, OneTapIsChapter03) {
    for (const std::string& name : testScenes()) {
        for (const bool plane : {false, true}) {
            ChapterHarness harness(chapter(), testScene(name));
            harness.set("kernel-width", "1");
            harness.set("receiver-plane", plane ? "true" : "false");
            const BiasMethod method = plane ? BiasMethod::receiverPlane : BiasMethod::slope;
            expectImage("04_pcf/" + shortName(name) + (plane ? "/one_tap_plane" : "/one_tap"),
                        harness.scalar("visibility", size), visibilityOfChapter03(harness, size, method), {},
                        {.maxAbs = 0.0});
        }
    }
}

// --- an edge along the texels ---

TEST(Chapter04, AnEdgeAlongTheTexelsHasOneLevelMoreThanTheKernelIsWide) {
    for (int n = 1; n <= 15; ++n) {
        const EdgeScene edge(0.0, 32);
        ChapterHarness harness(chapter(), edge.scene);
        harness.set("map-size", "32");
        harness.set("kernel-width", std::to_string(n));
        const FloatImage visibility = harness.scalar("visibility", glm::ivec2(256));
        const std::set<float> levels(visibility.values.begin(), visibility.values.end());
        ASSERT_EQ(levels.size(), std::size_t(n) + 1) << "kernel of " << n;
        int tests = 0;
        for (const float level : levels) EXPECT_EQ(level, float(tests++ * n) / float(n * n));
    }
}

TEST(Chapter04, FourOfNineTestsAreFourNinths) {
    // The shadow of a quarter plane: where its corner meets the middle texel, 3 x 3 tests say 4 of 9.
    const EdgeScene corner(0.0, 32, 0.37, Occluder::quarterPlane);
    ChapterHarness harness(chapter(), corner.scene);
    harness.set("map-size", "32");
    harness.set("kernel-width", "3");
    const FloatImage visibility = harness.scalar("visibility", glm::ivec2(256));
    std::set<float> levels(visibility.values.begin(), visibility.values.end());
    // Dark: i x j texels of 9, i and j of 0 to 3.
    const std::set<float> expected{0.0f,        3.0f / 9.0f, 5.0f / 9.0f, 6.0f / 9.0f,
                                   7.0f / 9.0f, 8.0f / 9.0f, 1.0f};
    EXPECT_EQ(levels, expected);
    // Seen from the other side: 4 lit of 9.
    const EdgeScene hole(0.0, 32, 0.37, Occluder::allButAQuarter);
    ChapterHarness other(chapter(), hole.scene);
    other.set("map-size", "32");
    other.set("kernel-width", "3");
    const FloatImage inverse = other.scalar("visibility", glm::ivec2(256));
    EXPECT_TRUE(std::find(inverse.values.begin(), inverse.values.end(), 4.0f / 9.0f) != inverse.values.end());
}

TEST(Chapter04, BilinearTapsMakeOneLinearRamp) {
    for (const auto& [k, plane] :
         {std::pair(0, "false"), {1, "false"}, {3, "false"}, {0, "true"}, {1, "true"}, {3, "true"}}) {
        const EdgeScene edge(0.0, 32);
        ChapterHarness harness(chapter(), edge.scene);
        harness.set("map-size", "32");
        harness.set("kernel-width", std::to_string(2 * k + 1));
        harness.set("bilinear", "true");
        harness.set("receiver-plane", plane);  // blended by the sampler, and by the shader
        const FloatImage actual = harness.scalar("visibility", glm::ivec2(256));
        FloatImage exact(256, 256, 1);
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x)
                exact.at(x, y) = float(bilinearCompareRamp(edge.texelisedDistance(x, y, 256), k));
        // Samplers may blend with weights of 8 bits; taps fall on the texels' centres to within 1e-4 of a
        // texel.
        expectImage("04_pcf/ramp" + std::to_string(2 * k + 1) + "_plane_" + plane, actual, exact, {},
                    {.maxAbs = (1.0 / 256 + 1e-3) / (2 * k + 1)});
    }
}

// --- edges in all directions: the filter's limit, up to what texels cannot tell ---

struct EdgeError {
    double meanAbs = 0, rms = 0, bias = 0;
};

/// Over the pixels where the box, `width` texels wide, is neither all lit nor all dark.
EdgeError errorOfEdge(double angle, int width, bool bilinear) {
    EdgeError error;
    double pixels = 0;
    for (int phase = 0; phase < 4; ++phase) {
        const EdgeScene edge(angle, 32, (phase + 0.37) / 4);
        ChapterHarness harness(chapter(), edge.scene);
        harness.set("map-size", "32");
        harness.set("kernel-width", std::to_string(width));
        harness.set("bilinear", bilinear ? "true" : "false");
        const FloatImage actual = harness.scalar("visibility", glm::ivec2(192));
        for (int y = 0; y < 192; ++y) {
            for (int x = 0; x < 192; ++x) {
                const double exact = boxCoverage(edge.distance(x, y, 192), width, edge.normal());
                if (exact <= 0.0 || exact >= 1.0 || edge.inside(x, y, 192) < 0.5 * width + 1.0) continue;
                const double difference = actual.at(x, y) - exact;
                error.meanAbs += std::abs(difference);
                error.rms += difference * difference;
                error.bias += difference;
                ++pixels;
            }
        }
    }
    return {error.meanAbs / pixels, std::sqrt(error.rms / pixels), error.bias / pixels};
}

/// A texelised edge is off by an area of c/4 + s^2/(12c) for each unit of its length, squared texels
/// (expectedMisArea), and a box of width w holds at most w/c of it: a mean error of (1/4 + s^2/(12 c^2)) / w.
/// For edges along the texels that is exact: uniform in +-1/(2w), whose rms is 2/sqrt(3) times its mean.
double texelLimit(double angle, int width) {
    const double c = std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    const double s = std::min(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    return (0.25 + s * s / (12.0 * c * c)) / width;
}

/// The rms of that, and of nearest taps besides: their lattice lies anywhere within a texel of where it
/// should be, which moves the kernel by 1/sqrt(12) texel (rms) across the edge, and the box's profile rises
/// by at most 1/(w c) a texel.
double rmsLimit(double angle, int width, bool bilinear) {
    const double c = std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    const double texels = 2.0 / std::sqrt(3.0) * texelLimit(angle, width);
    return std::hypot(texels, bilinear ? 0.0 : 1.0 / (std::sqrt(12.0) * width * c));
}

/// A mean over four phases is not quite the mean over all: 5 % of the error, and an eighth of a texel of its
/// mean.
bool keepsLimits(const EdgeError& error, double angle, int width, bool bilinear) {
    return error.rms < 1.05 * rmsLimit(angle, width, bilinear) && std::abs(error.bias) < 0.125 / width &&
           (!bilinear || error.meanAbs < 1.05 * texelLimit(angle, width));
}

TEST(Chapter04, EdgesAreTheBoxFiltersUpToTheTexels) {
    for (const bool bilinear : {false, true}) {
        for (const int width : {3, 5, 9}) {
            for (int k = 0; k < 8; ++k) {
                const double angle = 3.141592653589793 * k / 8.0;
                const EdgeError error = errorOfEdge(angle, width, bilinear);
                EXPECT_TRUE(keepsLimits(error, angle, width, bilinear))
                    << width << " texels, edge " << k << ", bilinear " << bilinear << ": mean "
                    << error.meanAbs << ", rms " << error.rms << ", bias " << error.bias;
            }
        }
        EXPECT_GT(errorOfEdge(0.0, 5, bilinear).rms, 0.85 * rmsLimit(0.0, 5, bilinear)) << "a loose limit";
    }
}

// --- scenes ---

/// Of the truth itself: rays against the closed form.
TEST(Chapter04, TheFiltersTruthIsTheClosedFormAtAnEdge) {
    for (const auto shape : {FilterKernel::Shape::square, FilterKernel::Shape::disk}) {
        const EdgeScene edge(0.4, 32);
        const RayTracer tracer(edge.scene);
        constexpr double texels = 6.0;
        ShadowOptions options;
        options.fit = "view";
        const ProgressCallback silent;
        const TruthImage truth = filterTruth(
            {edge.scene, tracer, edge.scene.cameras[0], glm::ivec2(96), "visibility", silent, nullptr},
            options, {shape, texels, 32});
        FloatImage exact(96, 96, 1), penumbra(96, 96, 1);
        for (int y = 0; y < 96; ++y) {
            for (int x = 0; x < 96; ++x) {
                const double d = edge.distance(x, y, 96);
                const double V = shape == FilterKernel::Shape::disk ? diskCoverage(d, texels)
                                                                    : boxCoverage(d, texels, edge.normal());
                exact.at(x, y) = float(V);
                penumbra.at(x, y) = V > 0.0 && V < 1.0 ? 1.0f : 0.0f;
            }
        }
        // 1024 Owen-scrambled points: 0.0018 rms on random edges; a touch of less than 1/64 may be missed.
        expectImage(std::string("04_pcf/truth_") + (shape == FilterKernel::Shape::disk ? "disk" : "square"),
                    truth.value, exact, penumbra, {.rmse = 0.0025, .maxAbs = 0.03, .absBias = 3e-4});
        expectImage(std::string("04_pcf/truth_everywhere_") +
                        (shape == FilterKernel::Shape::disk ? "disk" : "square"),
                    truth.value, exact, {}, {.maxAbs = 0.03});
    }
}

class AgainstTruth : public testing::TestWithParam<std::string> {};

/// What texels cannot tell of a box 7 wide, times the share of pixels in a penumbra, with a third of reserve:
/// measured 0.0066, 0.015 and 0.018 with nearest taps, 0.0031, 0.0066 and 0.0107 with blended ones, which
/// have no lattice. No bias at all: the plane is followed to the centre of every texel. The engine's fins are
/// slivers, which turn over when the rasteriser snaps their corners: a few single pixels are dark, whatever
/// the filter.
ImageBounds errorBounds(const std::string& scene, bool bilinear) {
    if (scene == thirdPartyModel) return {.meanAbs = 0.02, .absBias = 0.003};
    if (scene == "courtyard") return {.rmse = bilinear ? 0.0143 : 0.024, .absBias = 0.0005};
    if (scene == "contact") return {.rmse = bilinear ? 0.0088 : 0.02, .absBias = 0.0005};
    return {.rmse = bilinear ? 0.0044 : 0.0088, .absBias = 0.0005};
}

double rmseOf(ChapterHarness& harness) {
    const TruthImage truth = harness.truth("visibility", size);
    return compareImages(harness.scalar("visibility", size), truth.value, truth.mask).rmse;
}

TEST_P(AgainstTruth, TheFiltersLimit) {
    for (const bool bilinear : {false, true}) {
        ChapterHarness harness(chapter(), testScene(GetParam()));
        harness.set("kernel-width", "7");
        harness.set("receiver-plane", "true");
        harness.set("bilinear", bilinear ? "true" : "false");
        const TruthImage truth = harness.truth("visibility", size);
        EXPECT_EQ(truth.against, "filter");
        expectImage("04_pcf/" + shortName(GetParam()) + (bilinear ? "/bilinear" : "/visibility"),
                    harness.scalar("visibility", size), truth.value, truth.mask,
                    errorBounds(GetParam(), bilinear));
    }
}
INSTANTIATE_TEST_SUITE_P(Chapter04, AgainstTruth, testing::ValuesIn(testScenes()), sceneTestName);

TEST(Chapter04, TheAreaLightIsSomethingElse) {
    ChapterHarness harness(chapter(), testScene("heckbert_herf"));
    const auto area = harness.areaLightTruth("visibility", size);
    ASSERT_TRUE(area);
    EXPECT_EQ(area->against, "area light");
    const FloatImage actual = harness.scalar("visibility", size);
    EXPECT_GT(compareImages(actual, area->value, area->mask).rmse, 10.0 * rmseOf(harness));
    EXPECT_FALSE(harness.areaLightTruth("color", size));
    ChapterHarness sun(chapter(), testScene("contact"));
    EXPECT_FALSE(sun.areaLightTruth("visibility", size));
}

TEST(Chapter04, MeansOfDepthsAreWrong) {
    ChapterHarness harness(chapter(), testScene("heckbert_herf"));
    harness.set("kernel-width", "7");
    const double tests = rmseOf(harness);
    harness.set("filter", "depths");
    EXPECT_GT(rmseOf(harness), 5.0 * tests);
    for (const float S : harness.scalar("visibility", size).values) EXPECT_TRUE(S == 0.0f || S == 1.0f);
}

// --- acne ---

AcneCount acneOnPlanes(const std::string& bias, const std::string& width, bool bilinear, bool plane,
                       const std::string& format) {
    constexpr int planes = 12;
    constexpr LightType types[] = {LightType::spot, LightType::point, LightType::directional};
    AcneCount total;
    for (int i = 0; i < planes; ++i) {
        std::mt19937 random(2000 + i);
        const Scene scene = tiltedPlane(85.0 * radiansPerDegree * i / (planes - 1), types[i % 3], random);
        ChapterHarness harness(chapter(), scene);
        harness.set("kernel-width", width);
        harness.set("bilinear", bilinear ? "true" : "false");
        harness.set("receiver-plane", plane ? "true" : "false");
        harness.set("bias", bias);
        harness.set("depth-format", format);
        harness.set("map-size", std::to_string(128 << (i % 3)));
        total += countAcne(harness, 160, 0.999f);
    }
    return total;
}

class KernelAwareBound : public testing::TestWithParam<std::string> {};

TEST_P(KernelAwareBound, RemovesAllAcneUpTo85Degrees) {
    for (const char* width : {"1", "2", "3", "7"}) {
        for (const bool bilinear : {false, true}) {
            for (const bool plane : {false, true}) {
                const AcneCount count = acneOnPlanes("1", width, bilinear, plane, GetParam());
                EXPECT_GT(count.receivers, 100000u);
                EXPECT_EQ(count.dark, 0u) << width << " texels, bilinear " << bilinear << ", plane " << plane;
            }
        }
    }
}

TEST_P(KernelAwareBound, IsTight) {
    for (const char* width : {"3", "7"}) {
        EXPECT_GT(acneOnPlanes("0.9", width, false, false, GetParam()).dark, 1000u) << width;
        EXPECT_GT(acneOnPlanes("0.9", width, true, false, GetParam()).dark, 500u) << width << " bilinear";
    }
}

std::string formatName(const testing::TestParamInfo<std::string>& format) {
    std::string name = format.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Chapter04, KernelAwareBound, testing::Values("16", "24", "32f", "32f-reversed"),
                         formatName);

TEST(Chapter04, FollowingThePlaneDetachesNothing) {
    const auto leak = [](const char* width, bool plane) {
        const Scene scene = wallOnGround(LightType::spot);
        ChapterHarness harness(chapter(), scene);
        harness.set("map-size", "512");
        harness.set("kernel-width", width);
        harness.set("receiver-plane", plane ? "true" : "false");
        return leakLength(harness, 256);
    };
    EXPECT_GT(leak("9", false), 4.0 * leak("1", false)) << "the bias grows with the kernel";
    EXPECT_LT(leak("9", true), 0.3 * leak("9", false));
}

// --- the rest ---

TEST(Chapter04, SkippingChangesNoBit) {
    for (const std::string& name : testScenes()) {
        ChapterHarness harness(chapter(), testScene(name));
        const FloatImage skipped = harness.picture("color", size, 3);
        EXPECT_EQ(harness.work["tests_per_pixel"], 9);
        harness.skip = false;
        expectImage("04_pcf/" + shortName(name) + "/skip", harness.picture("color", size, 3), skipped, {},
                    {.maxAbs = 0.0});
    }
}

TEST(Chapter04, EsShowsTheSamePicture) {
    for (const char* bilinear : {"false", "true"}) {
        FloatImage pictures[2];
        for (const Api api : {Api::desktop, Api::es}) {
            ChapterHarness harness(chapter(), testScene("contact"), api);
            harness.set("bilinear", bilinear);
            pictures[api == Api::es] = harness.scalar("visibility", size);
        }
        expectImage(std::string("04_pcf/contact/es_bilinear_") + bilinear, pictures[1], pictures[0], {},
                    {.meanAbs = 1e-3});
    }
}

/// Each broken shader must break a bound that the true one keeps.
TEST(Chapter04, ABrokenShaderIsCaught) {
    const std::string pcf = "04_pcf/pcf.glsl", receiver = "04_pcf/receiver.glsl";
    struct Mutation {
        const char* what;
        std::string file, from, to;
    };
    const auto keepsBounds = [] {
        for (const bool bilinear : {false, true}) {
            for (const double angle : {0.0, 0.4}) {
                if (!keepsLimits(errorOfEdge(angle, 5, bilinear), angle, 5, bilinear)) return false;
            }
            for (const bool plane : {false, true})
                if (acneOnPlanes("1", "7", bilinear, plane, "24").dark > 0) return false;
        }
        const Scene scene = wallOnGround(LightType::spot);
        for (const char* bilinear : {"false", "true"}) {
            ChapterHarness wall(chapter(), scene);
            wall.set("map-size", "512");
            wall.set("kernel-width", "9");
            wall.set("receiver-plane", "true");
            wall.set("bilinear", bilinear);
            if (leakLength(wall, 256) >= 0.06) return false;
        }
        const EdgeScene edge(0.0, 32);
        ChapterHarness ramp(chapter(), edge.scene);
        ramp.set("map-size", "32");
        ramp.set("receiver-plane", "true");
        ramp.set("bilinear", "true");
        const FloatImage actual = ramp.scalar("visibility", glm::ivec2(128));
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                if (std::abs(actual.at(x, y) - bilinearCompareRamp(edge.texelisedDistance(x, y, 128), 1)) >
                    1e-3)
                    return false;
        return true;
    };
    const Mutation mutations[] = {
        {"kernel not centred", pcf,
         "lit += litByTexel(receiver, texelBeside(receiver.str.xy, vec2(i, j) - k), bias);",
         "lit += litByTexel(receiver, texelBeside(receiver.str.xy, vec2(i, j) - k + 1.0), bias);"},
        {"one column missing", pcf, "for (int i = 0; i < uKernelWidth; ++i)\n            lit += litByTexel",
         "for (int i = 1; i < uKernelWidth; ++i)\n            lit += litByTexel"},
        {"bias of one tap", receiver, "return texels * slopePerTexel(", "return 0.0 * slopePerTexel("},
        {"bilinear footprint forgotten", pcf, "0.5 * receiver.slope.atMost / mapSize", "0.0"},
        {"one depth for four texels", pcf, "litByTexel(receiver, texel, bias)",
         "(uFarther * (receiver.str.z - nearestDepth(texel)) > bias ? 0.0 : 1.0)"},
        {"a tap's share the wrong way round", pcf, "min(ij + 1.0 - f, n - ij + f)",
         "min(ij + f, n + 1.0 - ij - f)"},
        {"bilinear taps half a texel off", pcf, "(vec2(i, j) - k) / mapSize",
         "(vec2(i, j) - k + 0.5) / mapSize"},
        {"plane followed backwards", receiver, "uFollowPlane * receiver.slope.value, st - receiver.str.xy",
         "uFollowPlane * receiver.slope.value, receiver.str.xy - st"},
        {"plane at the texel's corner", receiver, "vec2 centre = (vec2(texel) + 0.5)",
         "vec2 centre = vec2(texel)"},
        {"offsets in the wrong unit", receiver, "st * vec2(size) + offset", "(st + offset) * vec2(size)"},
    };
    EXPECT_TRUE(keepsBounds());
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(m.file, m.from, m.to);
        EXPECT_FALSE(keepsBounds()) << m.what;
    }
}

}  // namespace
}  // namespace penumbra
