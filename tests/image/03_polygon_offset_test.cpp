// Chapter 03 against the truth. The chapter's own class is tested, so its main.cpp is part of this file.
#define main chapterMain
#include "chapters/03_polygon_offset/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "common/truth/shadow_polygon.h"
#include "tests/image/bias_scenes.h"
#include "tests/image/image_check.h"
#include "tests/image/moved_scene.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(192, 192);

std::unique_ptr<Chapter> chapter() {
    return std::make_unique<PolygonOffset>();
}

/// 18 planes tilted from 0 to 85 degrees, under spot, point and directional lights, maps of 64 to 512
/// texels, fitted to the scene and to what the camera sees: 1.1 million receivers.
AcneCount acneOnPlanes(const std::string& method, const std::string& bias, const std::string& format) {
    constexpr int planes = 18;
    constexpr LightType types[] = {LightType::spot, LightType::point, LightType::directional};
    AcneCount total;
    for (int i = 0; i < planes; ++i) {
        std::mt19937 random(1000 + i);
        const Scene scene = tiltedPlane(85.0 * radiansPerDegree * i / (planes - 1), types[i % 3], random);
        ChapterHarness harness(chapter(), scene);
        harness.set("method", method);
        harness.set("bias", bias);
        harness.set("depth-format", format);
        harness.set("map-size", std::to_string(64 << (i % 4)));
        harness.set("fit", i % 2 ? "view" : "scene");
        total += countAcne(harness, 256);
    }
    return total;
}

/// Along the sliver that clipping leaves at a seam, rasterisers interpolate worst: 120 seams, each with a
/// light and a map of its own.
AcneCount acneOnSeams(const std::string& method, const std::string& format) {
    constexpr LightType types[] = {LightType::spot, LightType::point, LightType::directional};
    AcneCount total;
    for (int i = 0; i < 120; ++i) {
        std::mt19937 random(i);
        const double tilt = 85.0 * std::uniform_real_distribution<double>(0.0, 1.0)(random);
        Scene scene = tiltedPlane(tilt * radiansPerDegree, types[i % 3], random);
        turnSeamIntoCorners(scene, random);
        ChapterHarness harness(chapter(), scene);
        harness.set("method", method);
        harness.set("depth-format", format);
        harness.set("map-size", std::to_string(64 << (i % 5)));
        harness.set("fit", "view");
        total += countAcne(harness, 192);
    }
    return total;
}

class DerivedBound : public testing::TestWithParam<std::string> {};

TEST_P(DerivedBound, RemovesAllAcneAndNineTenthsOfItDoNot) {
    const AcneCount whole = acneOnPlanes("slope", "1", GetParam());
    EXPECT_GE(whole.receivers, 1000000u);
    EXPECT_EQ(whole.dark, 0u);
    EXPECT_GT(acneOnPlanes("slope", "0.9", GetParam()).dark, 1000u) << "the bound is not tight";
}

TEST_P(DerivedBound, HoldsHoweverItIsSpent) {
    for (const char* method : {"polygon-offset", "receiver-plane", "normal-offset"})
        EXPECT_EQ(acneOnPlanes(method, "1", GetParam()).dark, 0u) << method;
    EXPECT_GT(acneOnPlanes("normal-offset", "0.9", GetParam()).dark, 1000u) << "the offset is not tight";
}

TEST_P(DerivedBound, HoldsAlongSeams) {
    for (const char* method : {"slope", "receiver-plane", "normal-offset"})
        EXPECT_EQ(acneOnSeams(method, GetParam()).dark, 0u) << method;
}

TEST_P(DerivedBound, IsNeeded) {
    EXPECT_GT(acneOnPlanes("none", "1", GetParam()).fraction(), 0.3);
    // An epsilon that is right at 60 degrees is too small at 85.
    EXPECT_GT(acneOnPlanes("constant", "1", GetParam()).dark, 1000u);
}

std::string formatName(const testing::TestParamInfo<std::string>& format) {
    std::string name = format.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Chapter03, DerivedBound, testing::Values("16", "24", "32f", "32f-reversed"),
                         formatName);

class AgainstTruth : public testing::TestWithParam<std::string> {};

/// What is left is the staircase of the shadow's edge (chapter 04's subject): a share of the pixels that
/// grows with the length of edges in them, as many too dark as too light. Measured, and half as much again.
double errorBound(const std::string& scene) {
    if (scene == "heckbert_herf") return 1.5 * 0.0007;
    if (scene == "contact") return 1.5 * 0.0039;
    return 1.5 * 0.0081;  // courtyard: leaves and railings; the engine: concave tubes finer than a texel
}

TEST_P(AgainstTruth, OnlyTheEdgesOfShadowsAreWrong) {
    ChapterHarness harness(chapter(), testScene(GetParam()));
    harness.set("map-size", "1024");
    const TruthImage truth = harness.truth("visibility", size);
    expectImage("03_polygon_offset/" + shortName(GetParam()) + "/visibility",
                harness.scalar("visibility", size), truth.value, truth.mask,
                {.meanAbs = errorBound(GetParam()), .absBias = 0.6 * errorBound(GetParam())});
}
INSTANTIATE_TEST_SUITE_P(Chapter03, AgainstTruth, testing::ValuesIn(testScenes()), sceneTestName);

TEST(Chapter03, FrontFaceCullingAndMidpointNeedClosedParts) {
    // A closed box on an open sheet. Front faces: the box is right, the sheet has its acne back. Midpoint:
    // both right, since nothing is behind the sheet.
    const Scene scene = SmallScene()
                            .quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})
                            .box({-0.5, 0.5, -0.5}, {0.5, 1.5, 0.5})
                            .light(LightType::directional, {0, 0, 0}, {0.5, -1, -0.8})
                            .camera({1, 4, 5}, {0, 0.5, 0}, 0.6)
                            .take();
    const RayTracer tracer(scene);
    ChapterHarness harness(chapter(), scene);
    const PrimaryHits seen = primaryHits(tracer, harness.camera, size);
    const TruthImage truth = harness.truth("visibility", size);
    const auto acne = [&](const std::string& method, std::uint32_t part) {
        harness.set("method", method);
        const FloatImage visibility = harness.scalar("visibility", size);
        double lit = 0, dark = 0;
        for (std::size_t i = 0; i < seen.hits.size(); ++i) {
            if (truth.mask.values[i] == 0.0f || truth.value.values[i] < 0.5f || seen.hits[i].part != part)
                continue;
            ++lit;
            dark += visibility.values[i] < 0.5f;
        }
        return dark / lit;
    };
    EXPECT_GT(acne("none", 0), 0.3);
    EXPECT_GT(acne("none", 1), 0.2);
    EXPECT_GT(acne("front-face", 0), 0.3);
    EXPECT_LT(acne("front-face", 1), 0.01);
    EXPECT_LT(acne("midpoint", 0), 0.01);
    EXPECT_LT(acne("midpoint", 1), 0.01);
}

/// Share of |map - exact| in what section "Hard shadows" predicts for random edges, averaged over sub-texel
/// positions.
double misAreaOverPredicted(double angle, int mapSize, int phases, double* misArea = nullptr) {
    constexpr int pixels = 256;
    const glm::dvec3 light(0, 4, 0);
    const glm::dvec3 along(std::cos(angle), 0, std::sin(angle)), across(-std::sin(angle), 0, std::cos(angle));
    double measured = 0, predicted = 0;
    for (int phase = 0; phase < phases; ++phase) {
        // One edge through the picture, half way between light and ground: its shadow moves two steps for
        // one.
        const double texel = 1.0 / mapSize, shift = 0.5 * texel * (phase + 0.37) / phases;
        const glm::dvec3 middle = glm::dvec3(0.01, 2, 0.013) + shift * across;
        const Triangle occluder{middle - 9.0 * along, middle + 9.0 * along, middle + 9.0 * across};
        const Scene scene = SmallScene()
                                .quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})
                                .part({occluder}, false)
                                .light(LightType::spot, light, {0, -1, 0}, 0.5)
                                .flatCamera({0, 1, 0}, {0, 0, 0}, 1.0)
                                .take();
        ChapterHarness harness(chapter(), scene);
        harness.set("map-size", std::to_string(mapSize));
        harness.set("fit", "view");  // the map's axes and borders are the picture's
        const FloatImage visibility = harness.scalar("visibility", glm::ivec2(pixels));

        const PlanarReceiver receiver{{-0.5, 0, 0.5}, {1, 0, 0}, {0, 0, -1}};
        const Polygon2 shadow = shadowPolygon(occluder, light, receiver);
        for (int y = 0; y < pixels; ++y) {
            for (int x = 0; x < pixels; ++x) {
                const glm::dvec2 uv((x + 0.5) / pixels, 1.0 - (y + 0.5) / pixels);
                const double coverage = cellCoverage(shadow, uv - 1e-9, uv + 1e-9);
                measured += std::abs((1.0 - visibility.at(x, y)) - coverage) / (double(pixels) * pixels);
            }
        }
        double length = 0;  // of the shadow's boundary inside the picture
        for (int i = 0; i < shadow.count; ++i) {
            const glm::dvec2 a = shadow[i], b = shadow[shadow.next(i)];
            const auto onBorder = [&](int axis, double border) {
                return std::abs(a[axis] - border) < 1e-9 && std::abs(b[axis] - border) < 1e-9;
            };
            if (!onBorder(0, 0) && !onBorder(0, 1) && !onBorder(1, 0) && !onBorder(1, 1))
                length += glm::length(b - a);
        }
        const LightFrustum frustum = fitLightFrustum(scene, scene.lights[0], harness.camera, 1.0);
        predicted +=
            expectedMisArea({std::cos(angle), std::sin(angle)}) * frustum.texelSize(4.0, mapSize).x * length;
    }
    if (misArea) *misArea = measured / phases;
    return measured / predicted;
}

TEST(Chapter03, EdgesAreWrongByTheAreaThatTheoryPredicts) {
    for (int k = 0; k < 8; ++k) {
        const double angle = 3.141592653589793 * k / 8.0;
        const double ratio = misAreaOverPredicted(angle, 32, 8);
        EXPECT_GT(ratio, 0.9) << "edge at " << angle / radiansPerDegree << " degrees";
        EXPECT_LT(ratio, 1.1) << "edge at " << angle / radiansPerDegree << " degrees";
    }
}

TEST(Chapter03, ThatAreaHalvesWhenTheResolutionDoubles) {
    double coarse = 0, fine = 0;
    misAreaOverPredicted(0.4, 16, 8, &coarse);
    misAreaOverPredicted(0.4, 64, 8, &fine);
    const double slope = std::log2(fine / coarse) / 2.0;
    EXPECT_NEAR(slope, -1.0, 0.05);
}

TEST(Chapter03, LightLeaksUnderTheWallByTheBiasAndNoMore) {
    for (const char* format : {"16", "24", "32f"}) {
        const Scene scene = wallOnGround(LightType::spot);
        ChapterHarness harness(chapter(), scene);
        harness.set("depth-format", format);
        harness.set("map-size", "512");
        const LightFrustum frustum = fitLightFrustum(scene, scene.lights[0]);
        const double eyeDepth = frustum.axisDistance({0, 0, 0});
        const double texel = frustum.texelSize(eyeDepth, 512).y * std::sqrt(2.0);  // on ground at 45 degrees
        // B at the foot of the wall, window depth -> metres along the light -> metres along the ground.
        const glm::dvec2 slope = depthSlope(frustum.textureFromWorld(), {0, 0, 0}, {0, 1, 0});
        const double S = 0.5 / 512 * (std::abs(slope.x) + std::abs(slope.y));
        const double B = S + depthQuantum(depthFormat(format, harness.capabilities()), 0.5);
        const double z = frustum.windowDepth(eyeDepth);
        const double metres = (frustum.eyeDepth(z + B) - eyeDepth) / std::sqrt(2.0);
        EXPECT_LT(leakLength(harness, 256), metres + texel) << format;
        harness.set("bias", "16");
        const double wide = (frustum.eyeDepth(z + 16 * B) - eyeDepth) / std::sqrt(2.0);
        EXPECT_NEAR(leakLength(harness, 256), wide, 0.1 * wide + texel)
            << format << ": the leak is the bias, seen sideways";
        // Comparing at the texel's centre needs no S: the shadow touches the wall but for the texel it ends
        // in.
        harness.set("bias", "1");
        harness.set("method", "receiver-plane");
        EXPECT_LT(leakLength(harness, 256), texel) << format;
    }
}

TEST(Chapter03, TheSameFarFromTheOrigin) {
    for (const char* name : {"contact", "courtyard"}) {
        const Scene moved = movedScene(name, 1e6);
        FloatImage pictures[2];
        for (int i = 0; i < 2; ++i) {
            ChapterHarness harness(chapter(), i ? moved : testScene(name));
            pictures[i] = harness.scalar("visibility", size);
        }
        // At 1e6 doubles are 1e-10 m apart: a float position moves by a last bit now and then, and so may a
        // texel on an edge.
        expectImage(std::string("03_polygon_offset/") + name + "/moved", pictures[1], pictures[0], {},
                    {.meanAbs = 3e-4});
    }
}

TEST(Chapter03, SkippingChangesNoBit) {
    for (const std::string& name : testScenes()) {
        for (const char* method : {"slope", "midpoint", "polygon-offset"}) {
            ChapterHarness harness(chapter(), testScene(name));
            harness.set("method", method);
            const FloatImage skipped = harness.picture("color", size, 3);
            harness.skip = false;
            expectImage("03_polygon_offset/" + shortName(name) + "/skip_" + method,
                        harness.picture("color", size, 3), skipped, {}, {.maxAbs = 0.0});
        }
    }
}

TEST(Chapter03, EsShowsTheSamePicture) {
    for (const std::string& name : {testScenes()[1], testScenes()[2]}) {
        FloatImage pictures[2];
        for (const Api api : {Api::desktop, Api::es}) {
            ChapterHarness harness(chapter(), testScene(name), api);
            pictures[api == Api::es] = harness.scalar("visibility", size);
        }
        // Without acne only texels on an edge can go either way.
        expectImage("03_polygon_offset/" + shortName(name) + "/es", pictures[1], pictures[0], {},
                    {.meanAbs = 1e-3});
    }
}

/// Each broken shader must break a bound that the true one keeps.
TEST(Chapter03, ABrokenShaderIsCaught) {
    const std::string lookup = "02_shadow_test/shadow_lookup.glsl", test = "03_polygon_offset/biased.frag",
                      bound = "03_polygon_offset/bias.glsl";
    struct Mutation {
        const char* what;
        std::string file, from, to;
    };
    const auto meanAbs = [](const std::string& scene) {
        ChapterHarness harness(chapter(), testScene(scene));
        const TruthImage truth = harness.truth("visibility", size);
        return compareImages(harness.scalar("visibility", size), truth.value, truth.mask).meanAbs;
    };
    const auto keepsBounds = [&meanAbs] {
        for (const char* scene : {"heckbert_herf", "contact"})
            if (meanAbs(scene) > errorBound(scene)) return false;
        const double ratio = misAreaOverPredicted(0.4, 32, 8);
        return ratio > 0.9 && ratio < 1.1 && acneOnPlanes("slope", "1", "24").dark == 0 &&
               acneOnSeams("receiver-plane", "24").dark == 0;
    };
    const Mutation mutations[] = {
        {"no bias", test, "> uBias * bias", "> 0.0"},
        {"flipped compare", test, "> uBias * bias ? 0.0 : 1.0", "> uBias * bias ? 1.0 : 0.0"},
        {"no divide by q", lookup, "float perQ = 1.0 / strq.w;", "float perQ = 1.0;"},
        {"half a texel to the right", lookup, "ivec2(st * vec2(size))",
         "ivec2(st * vec2(size) + vec2(0.5, 0.0))"},
        {"half a texel down", lookup, "ivec2(st * vec2(size))", "ivec2(st * vec2(size) - vec2(0.0, 0.5))"},
        {"y flipped", lookup, "ivec2(st * vec2(size))", "ivec2(vec2(st.x, 1.0 - st.y) * vec2(size))"},
        {"slope along s only", "03_polygon_offset/depth_slope.glsl",
         "abs(volumes.x) + abs(volumes.y) + unsure", "abs(volumes.x) + unsure"},
        {"a quarter of a texel, not half", bound, "(0.5 + uSnap)", "(0.25 + uSnap)"},
        {"interpolation trusted", bound, "8.0 * off", "0.0 * off"},
    };
    EXPECT_TRUE(keepsBounds());
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(m.file, m.from, m.to);
        EXPECT_FALSE(keepsBounds()) << m.what;
    }
}

/// Files that do not load are the business of tests/unit/assimp_models_test.cpp, which knows them by name.
TEST(Chapter03, EveryThirdPartyModelThatLoadsIsDrawn) {
    constexpr glm::ivec2 small(96, 96);
    int drawn = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator("/usr/share/assimp/models/glTF2")) {
        const std::string extension = entry.path().extension();
        if (extension != ".gltf" && extension != ".glb") continue;
        SCOPED_TRACE(entry.path().string());
        std::optional<Scene> scene;
        try {
            scene = loadGltf(entry.path());
        } catch (const Error&) {
            continue;
        }
        ChapterHarness harness(chapter(), *scene);
        const FloatImage color = harness.picture("color", small, 3);
        float low = color.values[0], high = color.values[0];
        for (const float value : color.values) {
            ASSERT_TRUE(std::isfinite(value));
            low = std::min(low, value);
            high = std::max(high, value);
        }
        EXPECT_LT(low, high) << "nothing but background";
        const TruthImage truth = harness.truth("visibility", small);
        // Measured: at most 0.8 % of the pixels (the engine's and the text's many edges), none on boxes.
        expectImage("03_polygon_offset/third_party_" + std::to_string(drawn) + "/visibility",
                    harness.scalar("visibility", small), truth.value, truth.mask,
                    {.meanAbs = 0.015, .excludedShare = 0.95});
        ++drawn;
    }
    EXPECT_GE(drawn, 19) << "install the Debian package assimp-testmodels";
}

}  // namespace
}  // namespace penumbra
