#include "chapters/07_branching/min_max_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "chapters/04_pcf/compare_sampler.h"
#include "chapters/07_branching/receiver_slopes.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/mutated_shaders.h"

namespace penumbra {
namespace {

/// Nothing but what ChapterHarness needs to make a frame.
struct NoChapter : Chapter {
    void declare(Parameters& parameters) override { parameters.skips().declare(keptMinMax); }
    void load(const Scene&, const Context*) override {}
    void render(const Frame&) override {}
    TruthImage truth(const TruthRequest&) override { return {}; }
};

struct Counts {
    int lit = 0, dark = 0, mixed = 0;
    int missed = 0;  ///< said to be lit or dark, and a tap disagrees
};

/// Classifies `rounds` times 262 144 random receivers against the shadow map of a scene.
Counts classifyRandomly(const std::string& sceneName, DepthFormat format, float radius, bool gather,
                        int rounds) {
    const Scene& scene = testScene(sceneName);
    ChapterHarness harness(std::make_unique<NoChapter>(), scene);
    Program depth("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
    ShadowMap map(1004, format);  // the last blocks stick out half way if it is no multiple of 8
    const Frame frame = harness.frame("color", {512, 512});
    const Light& light = scene.lights[0];
    const LightFrustum frustum = fitLightFrustum(scene, light, frame.camera, 1.0, depthRange(format));
    map.render(depth, frame, light, frustum);
    MinMaxMap minMax(gather);
    const auto slopes = dominantSlopes(largestPlanes(scene), frustum, light);
    minMax.build(map, frustum.range, slopes, radius + 1.0f / 64, frame);

    Program random("common/fullscreen.vert", "07_branching/random_receivers.frag", {"JITTER_ROTATION"});
    const CompareSampler compare(frustum.range, GL_NEAREST);
    random.setTexture("uShadowMap", GL_TEXTURE_2D, map.texture());
    random.setTexture("uShadowCompare", GL_TEXTURE_2D, map.texture(), compare.id());
    random.set("uFarther", frustum.range == DepthRange::reversed ? -1.0f : 1.0f);
    random.set("uRadius", radius);
    random.set("uSamples", 1024);
    random.set("uSlope0", slopes[0]);
    random.set("uSlope1", slopes[1]);
    minMax.set(random);
    RenderTarget target({512, 512}, harness.capabilities());
    const FullscreenTriangle triangle;
    glDisable(GL_DEPTH_TEST);
    Counts counts;
    for (int round = 0; round < rounds; ++round) {
        target.bind();
        random.set("uRound", round);
        random.prepareToDraw();
        triangle.draw();
        const FloatImage result = target.read(2);
        for (std::size_t i = 0; i < result.values.size(); i += 2) {
            const float known = result.values[i], lit = result.values[i + 1];
            counts.lit += known == 1.0f;
            counts.dark += known == 0.0f;
            counts.mixed += known == 0.5f;
            counts.missed += known != 0.5f && lit != known;
        }
    }
    return counts;
}

TEST(MinMaxMap, MissesNoneOfAMillionReceivers) {
    const Counts counts = classifyRandomly("courtyard", DepthFormat::fixed24, 8.0f, true, 4);
    EXPECT_GE(counts.lit + counts.dark + counts.mixed, 1000000);
    EXPECT_EQ(counts.missed, 0);
    // A classification that says "mixed" misses nothing either.
    EXPECT_GT(counts.lit, 100000);
    EXPECT_GT(counts.dark, 100000);
}

TEST(MinMaxMapSlow, WhateverTheFormatTheRadiusAndTheLookUp) {
    for (const DepthFormat format :
         {DepthFormat::fixed16, DepthFormat::float32, DepthFormat::float32Reversed})
        for (const float radius : {0.0f, 3.0f, 31.5f}) {
            const Counts counts = classifyRandomly("courtyard", format, radius, radius == 3.0f, 1);
            EXPECT_EQ(counts.missed, 0) << int(format) << " " << radius;
            EXPECT_GT(counts.lit + counts.dark, 10000) << int(format) << " " << radius;
        }
}

/// The test can fail: windows a texel off, or a block short, miss receivers.
TEST(MinMaxMap, AWindowTooSmallMisses) {
    const auto missed = [](const char* file, const char* from, const char* to) {
        const MutatedShaders mutated(file, from, to);
        return classifyRandomly("courtyard", DepthFormat::fixed24, 10.0f, false, 1).missed;
    };
    const char* classify = "07_branching/classify.glsl";
    EXPECT_GT(missed(classify, "windowAround(taps.st)", "windowAround(taps.st + 1.0 / 1004.0)"), 0);
    EXPECT_GT(missed("07_branching/min_max_dilate.frag", "i < COUNT", "i < COUNT - 1"), 0);
    EXPECT_GT(missed(classify, "(footprintTexels * texel + 6.0 * roundOff)", "6.0 * roundOff"), 0);
}

TEST(DominantSlopes, OfAFloorUnderTheSunIsTheFloors) {
    const Scene& scene = testScene("contact");
    const LightFrustum frustum = fitLightFrustum(scene, scene.lights[0], scene.cameras[0], 1.0);
    const auto planes = largestPlanes(scene);
    ASSERT_FALSE(planes.empty());
    for (std::size_t i = 1; i < planes.size(); ++i) EXPECT_LE(planes[i].area, planes[i - 1].area);
    const auto slopes = dominantSlopes(planes, frustum, scene.lights[0]);
    const glm::dvec2 floor = depthSlope(frustum.textureFromWorld(), planes[0].point, planes[0].normal);
    bool found = false;
    for (const glm::vec2& slope : slopes) found = found || glm::length(glm::dvec2(slope) - floor) < 1e-5;
    EXPECT_TRUE(found);
}

}  // namespace
}  // namespace penumbra
