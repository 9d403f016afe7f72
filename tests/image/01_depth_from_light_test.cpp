// Chapter 01 against the truth: every texel of the map is the depth of what lies behind its centre.
// The chapter's own class is tested, so its main.cpp is part of this file.
#define main chapterMain
#include "chapters/01_depth_from_light/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <algorithm>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "common/gl/render_target.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/image_check.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/small_scenes.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(192, 192);

std::unique_ptr<Chapter> chapter() {
    return std::make_unique<DepthFromLight>();
}

/// How the texels of a map compare with the rays through their centres.
struct MapCheck {
    std::size_t texels = 0, surfaces = 0, edges = 0, wrong = 0;
    double worstOverBound = 0.0;  ///< of the texels that are not on an edge
};

struct CastDepth {
    double window = 1.0, bound = 0.0;
    double snapped = 0.0;          ///< change of depth over the rasteriser's subpixel step
    std::uint32_t triangle = ~0u;  ///< none: nothing there
};

CastDepth castThrough(const RayTracer& tracer, const LightFrustum& frustum, const glm::dvec2& uv,
                      int lightPart, const DepthErrors& errors, int mapSize) {
    const Hit hit = tracer.nearest(frustum.ray(uv), lightPart);
    const double eyeDepth = hit.valid ? frustum.axisDistance(hit.position) : frustum.far;
    if (!hit.valid || eyeDepth >= frustum.far) return {frustum.windowDepth(frustum.far), 0.0, 0.0, ~0u};
    const double z = frustum.windowDepth(eyeDepth);
    const glm::dvec2 slope = depthSlope(frustum.textureFromWorld(), hit.position, hit.geometricNormal);
    return {z, texelDepthError(errors, z, eyeDepth, frustum.orthographic, slope, mapSize),
            (std::abs(slope.x) + std::abs(slope.y)) / 256.0 / mapSize, hit.triangle};
}

/// Within the bound of the ray through its centre, or, where an edge passes within the rasteriser's step of
/// the centre, between the surfaces on its sides.
MapCheck checkMap(const FloatImage& depths, const RayTracer& tracer, const LightFrustum& frustum,
                  int lightPart, const DepthErrors& errors) {
    MapCheck check;
    const int n = depths.width;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const double stored = depths.at(x, n - 1 - y);
            const auto cast = [&](double dx, double dy) {
                const glm::dvec2 uv = glm::dvec2(x + 0.5 + dx, y + 0.5 + dy) / double(n);
                return castThrough(tracer, frustum, uv, lightPart, errors, n);
            };
            const CastDepth centre = cast(0, 0);
            ++check.texels;
            check.surfaces += centre.triangle != ~0u;
            const double error = std::abs(stored - centre.window);
            if (error <= centre.bound) {
                if (centre.triangle != ~0u)
                    check.worstOverBound = std::max(check.worstOverBound, error / centre.bound);
                continue;
            }
            // Does an edge pass through the texel? Then its slope counts, over the rasteriser's subpixel
            // step; and within that step of the edge either side is right.
            double low = centre.window - centre.bound - centre.snapped;
            double high = centre.window + centre.bound + centre.snapped;
            bool edge = false;
            for (const glm::dvec2& corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
                edge |= cast(corner.x / 2, corner.y / 2).triangle != centre.triangle;
                const CastDepth side = cast(corner.x / 256, corner.y / 256);
                if (side.triangle == centre.triangle) continue;
                low = std::min(low, side.window - side.bound - 2.0 * side.snapped);
                high = std::max(high, side.window + side.bound + 2.0 * side.snapped);
            }
            (edge && stored >= low && stored <= high ? check.edges : check.wrong) += 1;
        }
    }
    return check;
}

struct MapRun {
    MapCheck check;
    LightFrustum frustum;
};

MapRun renderAndCheck(const std::string& sceneName, int lightIndex, const std::string& formatName,
                      int mapSize) {
    ChapterHarness harness(chapter(), testScene(sceneName));
    const Scene& scene = harness.scene;
    const Light& light = scene.lights.at(std::size_t(lightIndex));
    const DepthFormat format = depthFormat(formatName, harness.capabilities());
    MapRun run;
    run.frustum = fitLightFrustum(scene, light, harness.camera, 1.0, depthRange(format));
    Program program("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
    ShadowMap map(mapSize, format);
    map.render(program, harness.frame("depth", size), light, run.frustum);
    DepthErrors errors = depthErrors(format, run.frustum, scene.bounds, transformOperations);
    errors.snap = 0.0f;  // llvmpipe, the machine of these tests, snaps coverage but not depth: inside a
                         // triangle no slope term
    const RayTracer tracer(scene);
    run.check = checkMap(readDepthTexture(map.texture(), glm::ivec2(mapSize)), tracer, run.frustum,
                         light.part, errors);
    return run;
}

class Exactness : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(Exactness, EveryTexelIsTheDepthBehindItsCentre) {
    const auto& [scene, format] = GetParam();
    for (int light = 0; light < int(testScene(scene).lights.size()); ++light) {
        const MapCheck check = renderAndCheck(scene, light, format, 128).check;
        EXPECT_EQ(check.wrong, 0u) << scene << " light " << light;
        // Edges within 1/256 of a texel of a centre: a share of 1/128 times the length of edges in texels for
        // each texel. Leaves and railings have a lot of it.
        EXPECT_LT(check.edges, check.texels / 20) << scene << " light " << light;
        // The bound is of the right size: rounding to 16 bits uses half of the quantum, and the quantum is
        // half of the bound or more. What float rounds away adds up in the worst case and averages in
        // practice: a few per cent of its bound.
        EXPECT_GT(check.worstOverBound, format == "16" ? 0.2 : 0.02) << scene << " light " << light;
        EXPECT_GT(check.surfaces, check.texels / 20) << "an empty map proves nothing";
    }
}

std::string exactnessName(const testing::TestParamInfo<Exactness::ParamType>& info) {
    std::string name = shortName(std::get<0>(info.param)) + "_" + std::get<1>(info.param);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Chapter01, Exactness,
                         testing::Combine(testing::ValuesIn(testScenes()),
                                          testing::Values("16", "24", "32f", "32f-reversed")),
                         exactnessName);

TEST(Chapter01, ReversedFloatBeatsStandardFarFromTheLight) {
    // far / near is 300 here: standard depths crowd below 1, where float is no finer than 24 bits.
    const Scene scene = SmallScene()
                            .quad({-300, 0, 300}, {600, 0, 0}, {0, 0, -600})
                            .quad({-0.1, 29, -0.1}, {0.2, 0, 0}, {0, 0.1, 0.2})
                            .light(LightType::spot, {0, 30, 0}, {0.3, -1, 0.2}, 1.2)
                            .camera({0, 40, 1}, {0, 0, 0}, 2.4)
                            .take();
    double worst[2];
    int i = 0;
    for (const DepthFormat format : {DepthFormat::float32, DepthFormat::float32Reversed}) {
        ChapterHarness harness(chapter(), scene);
        const LightFrustum frustum =
            fitLightFrustum(scene, scene.lights[0], harness.camera, 1.0, depthRange(format));
        Program program("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
        ShadowMap map(128, format);
        map.render(program, harness.frame("depth", size), scene.lights[0], frustum);
        const FloatImage depths = readDepthTexture(map.texture(), glm::ivec2(128));
        const RayTracer tracer(scene);
        worst[i] = 0.0;
        for (int y = 0; y < 128; ++y) {
            for (int x = 0; x < 128; ++x) {
                const TexelDepth exact = exactTexelDepth(tracer, frustum, {x, y}, 128, format, -1);
                if (!exact.surface || !exact.defined) continue;
                const double metres = frustum.eyeDepth(exact.value),
                             stored = frustum.eyeDepth(depths.at(x, 127 - y));
                worst[i] = std::max(worst[i], std::abs(stored - metres) / metres);
            }
        }
        ++i;
    }
    EXPECT_LT(worst[1], 2e-6) << "reversed: a few roundings of 2^-24, whatever the distance";
    EXPECT_GT(worst[0], 3.0 * worst[1]) << "standard 32F gains nothing over 24 bits";
}

class Views : public testing::TestWithParam<std::string> {};

TEST_P(Views, DepthAndMetresAgreeWithRays) {
    ChapterHarness harness(chapter(), testScene(GetParam()));
    harness.set("map-size", "192");
    harness.set("depth-format", "24");
    const std::string name = "01_depth_from_light/" + shortName(GetParam()) + "/";
    const TruthImage depth = harness.truth("depth", size);
    // 99 % of the texels that no edge touches are within two quanta of 24 bits; steep ones and tiny triangles
    // less so, which Exactness bounds one by one.
    const ImageError error = expectImage(name + "depth", harness.scalar("depth", size), depth.value,
                                         depth.mask, {.rmse = 2e-6, .excludedShare = 0.2});
    EXPECT_LT(error.meanAbs, 2.0 / 16777215.0);
    const TruthImage metres = harness.truth("linear-depth", size);
    const LightFrustum frustum = fitLightFrustum(harness.scene, harness.scene.lights[0]);
    // A window depth that is off by d is off by d * metresPerDepth at the far end, where depth is coarsest.
    const double metresPerDepth = frustum.orthographic
                                      ? frustum.far - frustum.near
                                      : frustum.far * (frustum.far - frustum.near) / frustum.near;
    expectImage(name + "linear-depth", harness.scalar("linear-depth", size), metres.value, metres.mask,
                {.rmse = 2e-6 * metresPerDepth, .excludedShare = 0.2});
}
INSTANTIATE_TEST_SUITE_P(Chapter01, Views, testing::ValuesIn(testScenes()), sceneTestName);

class Fit : public testing::TestWithParam<std::string> {};

TEST_P(Fit, HoldsEveryLitReceiverAndLittleElse) {
    const Scene& scene = testScene(GetParam());
    const RayTracer tracer(scene);
    const PrimaryHits seen = primaryHits(tracer, scene.cameras[0], size);
    for (std::size_t i = 0; i < 2 * scene.lights.size(); ++i) {
        const Light& light = scene.lights[i / 2];
        const LightFrustum frustum =
            i % 2 == 0 ? fitLightFrustum(scene, light) : fitLightFrustum(scene, light, scene.cameras[0], 1.0);
        const glm::dmat4 textureFromWorld = frustum.textureFromWorld();
        const double widest = 0.999 * std::tan(widestHalfAngle);
        const bool capped =
            !frustum.orthographic && std::max(frustum.halfExtent.x, frustum.halfExtent.y) >= widest;
        std::size_t outside = 0, receivers = 0;
        for (const Hit& hit : seen.hits) {
            if (!hit.valid || int(hit.part) == light.part) continue;
            const glm::dvec3 toLight = directionToLight(light, hit.position);
            if (light.type == LightType::spot &&
                -glm::dot(toLight, light.direction) < std::cos(light.outerCone))
                continue;
            if (light.type == LightType::area && glm::dot(toLight, light.direction) >= 0.0) continue;
            const glm::dvec4 strq = textureFromWorld * glm::dvec4(hit.position, 1.0);
            const glm::dvec3 str = glm::dvec3(strq) / strq.w;
            ++receivers;
            outside += strq.w <= 0.0 || glm::any(glm::lessThan(str, glm::dvec3(0))) ||
                       glm::any(glm::greaterThan(str, glm::dvec3(1)));
        }
        EXPECT_GT(receivers, 100u) << light.name;
        EXPECT_TRUE(capped || outside == 0) << light.name << ": " << outside;
        EXPECT_LT(frustum.near, frustum.far);
    }
}
INSTANTIATE_TEST_SUITE_P(Chapter01, Fit, testing::ValuesIn(testScenes()), sceneTestName);

TEST(Chapter01, NearTouchesTheFirstCasterAndFarTheLastReceiver) {
    const Scene scene = SmallScene()
                            .quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})
                            .box({-0.2, 1.0, -0.2}, {0.2, 1.5, 0.2})
                            .quad({5, 3, 5}, {1, 0, 0}, {0, 0, -1})  // outside the pyramid: must not count
                            .light(LightType::spot, {0, 4, 0}, {0, -1, 0}, 0.4)
                            .camera({0, 5, 0.1}, {0, 0, 0}, 0.2)
                            .take();
    const LightFrustum frustum = fitLightFrustum(scene, scene.lights[0], scene.cameras[0], 1.0);
    EXPECT_NEAR(frustum.near, 2.5 * (1 - 1e-3), 1e-6);
    EXPECT_NEAR(frustum.far, 4.0 * (1 + 1e-3), 1e-6);
    // The camera sees 5 tan(0.1) to each side of the ground (and the top of the box higher up, within that).
    const double seen = 5.0 * std::tan(0.1) * 1.03;
    EXPECT_LT(frustum.halfExtent.y, seen / 2.5) << "no wider than what is seen, seen from the light";
}

TEST(Chapter01, AMapFittedToTheSceneIsKeptWhileTheCameraMoves) {
    ChapterHarness harness(chapter(), testScene("contact"));
    harness.picture("color", size, 3);
    for (const bool fitToView : {false, true}) {
        harness.set("fit", fitToView ? "view" : "scene");
        harness.picture("color", size, 3);
        harness.camera.position.x += 0.5;
        harness.picture("color", size, 3);
        EXPECT_EQ(harness.work["shadow_maps_rendered"], fitToView ? 1 : 0);
        harness.set("light", "1");
        harness.picture("color", size, 3);
        EXPECT_EQ(harness.work["shadow_maps_rendered"], 1) << "another light, another map";
        harness.set("light", "0");
    }
}

TEST(Chapter01, SkippingChangesNoBit) {
    for (const std::string& name : testScenes()) {
        for (int light = 0; light < int(testScene(name).lights.size()); ++light) {
            ChapterHarness harness(chapter(), testScene(name));
            harness.set("light", std::to_string(light));
            harness.set("map-size", "192");
            for (const char* view : {"depth", "color"}) {
                harness.skip = true;
                const FloatImage skipped = harness.picture(view, size, 3);
                harness.skip = false;
                EXPECT_EQ(harness.picture(view, size, 3), skipped)
                    << name << " light " << light << " " << view;
                EXPECT_EQ(harness.work["triangles_unseen"], 0) << name;
            }
        }
    }
}

TEST(Chapter01, NothingIsDrawnTwiceAndNothingOutsideTheFrustum) {
    const Scene scene = SmallScene()
                            .quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})
                            .box({50, 0, 50}, {51, 1, 51})
                            .light(LightType::spot, {0, 4, 0}, {0, -1, 0}, 0.4)
                            .camera({0, 5, 0.1}, {0, 0, 0}, 0.2)
                            .take();
    ChapterHarness harness(chapter(), scene);
    harness.scalar("depth", size);
    EXPECT_EQ(harness.work["shadow_maps_rendered"], 1);
    EXPECT_EQ(harness.work["triangles_submitted"], 2);
    EXPECT_EQ(harness.work["triangles_culled"], 12);
    harness.scalar("depth", size);
    EXPECT_EQ(harness.work.count("shadow_maps_rendered"), 0u)
        << "nothing changed: the map of the frame before serves";
    harness.set("map-size", "64");
    harness.scalar("depth", size);
    EXPECT_EQ(harness.work["shadow_maps_rendered"], 1);
}

TEST(Chapter01, EsShowsTheSamePicture) {
    for (const std::string& name : {testScenes()[1], testScenes()[3]}) {
        FloatImage desktop[2], es[2];
        for (const Api api : {Api::desktop, Api::es}) {
            ChapterHarness harness(chapter(), testScene(name), api);
            FloatImage* pictures = api == Api::es ? es : desktop;
            pictures[0] = harness.scalar("depth", size);
            pictures[1] = harness.picture("color", size, 3);
        }
        // Both are llvmpipe here; another driver may round the last bit of a 24-bit depth and of a colour the
        // other way.
        expectImage("01_depth_from_light/es_" + shortName(name) + "/depth", es[0], desktop[0], {},
                    {.rmse = 1e-6});
        expectImage("01_depth_from_light/es_" + shortName(name) + "/color", es[1], desktop[1], {},
                    {.rmse = 1e-5});
    }
}

TEST(Chapter01, ReversedDepthIsRefusedWithoutClipControl) {
    Capabilities none;
    try {
        depthFormat("32f-reversed", none);
        FAIL() << "accepted";
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("glClipControl"), std::string::npos) << error.what();
    }
}

/// Each broken shader must break what EveryTexelIsTheDepthBehindItsCentre checks.
TEST(Chapter01, ABrokenDepthPassIsCaught) {
    const std::string file = "01_depth_from_light/depth.vert",
                      line = "gl_Position = uLightClipFromWorld * vec4(aPosition, 1.0);";
    const std::pair<const char*, const char*> mutations[] = {
        {"half a texel to the right", "gl_Position.x += gl_Position.w / 128.0;"},
        {"y flipped", "gl_Position.y = -gl_Position.y;"},
        {"linear depth instead of z/w", "gl_Position.z *= gl_Position.w / 20.0;"},
        {"a ten-thousandth of the range too far", "gl_Position.z += 2e-4 * gl_Position.w;"},
    };
    EXPECT_EQ(renderAndCheck("contact", 0, "24", 128).check.wrong, 0u);
    for (const auto& [what, change] : mutations) {
        const MutatedShaders mutated(file, line, line + " " + change);
        EXPECT_GT(renderAndCheck("contact", 0, "24", 128).check.wrong, 100u) << "mutation: " << what;
    }
}

}  // namespace
}  // namespace penumbra
