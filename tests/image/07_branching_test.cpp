// Chapter 07: chapter 06, bit for bit, with less work. The chapters' own classes are tested, so their
// main.cpp are part of this file.
#define main chapter06Main
#include "chapters/06_jitter_texture/main.cpp"
#undef main
#define main chapterMain
#include "chapters/07_branching/main.cpp"
#undef main

#include <gtest/gtest.h>

#include "tests/image/chapter_harness.h"
#include "tests/image/image_check.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/small_scenes.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(192, 192);

std::unique_ptr<Chapter> chapter() {
    return std::make_unique<Branching>();
}

FloatImage picture(ChapterHarness& harness, const Settings& settings) {
    harness.set(settings);
    return harness.scalar("visibility", size);
}

/// Pixels in which the two chapters differ, and the largest difference.
struct Difference {
    int pixels = 0;
    float largest = 0.0f;
};
Difference difference(const Scene& scene, const Settings& common, const Settings& branching = {}) {
    ChapterHarness all(std::make_unique<JitterTextureChapter>(), scene), branched(chapter(), scene);
    const FloatImage exact = picture(all, common);
    picture(branched, common);
    const FloatImage actual = picture(branched, branching);
    Difference result;
    for (std::size_t i = 0; i < exact.values.size(); ++i) {
        const float d = std::abs(actual.values[i] - exact.values[i]);
        result.pixels += d != 0.0f;
        result.largest = std::max(result.largest, d);
    }
    return result;
}

class SameAsChapter06 : public testing::TestWithParam<std::string> {};

TEST_P(SameAsChapter06, BitForBit) {
    const Scene& scene = testScene(GetParam());
    const Settings cases[] = {{},
                              {{"radius", "0"}},
                              {{"radius", "3.7"}, {"map-size", "500"}},
                              {{"radius", "24"}, {"depth-format", "16"}},
                              {{"receiver-plane", "false"}},
                              {{"layout", "lecture"}, {"depth-format", "32f"}},
                              {{"method", "rotation"}, {"depth-format", "32f-reversed"}},
                              {{"bias", "0"}, {"samples", "16"}}};
    for (const Settings& settings : cases) {
        std::string name;
        for (const auto& [parameter, value] : settings) name += parameter + " " + value + " ";
        EXPECT_EQ(difference(scene, settings).pixels, 0) << name;
        EXPECT_EQ(difference(scene, settings, {{"branch", "if"}}).pixels, 0) << name << "if";
        EXPECT_EQ(difference(scene, settings, {{"classify", "none"}}).pixels, 0) << name << "none";
    }
}
INSTANTIATE_TEST_SUITE_P(Chapter07, SameAsChapter06, testing::Values("heckbert_herf", "contact", "fence"),
                         sceneTestName);
INSTANTIATE_TEST_SUITE_P(Chapter07Slow, SameAsChapter06,
                         testing::Values("courtyard", "spheres", thirdPartyModel), sceneTestName);

TEST(Chapter07, TheLecturesProbeMissesWires) {
    const Difference probe = difference(testScene("fence"), {}, {{"classify", "probe"}});
    EXPECT_GT(probe.pixels, size.x * size.y / 100);
    EXPECT_GT(probe.largest, 0.1f);
    // A straight edge it finds, but for the few pixels of which it cuts off less than the ring's gaps.
    EXPECT_LT(difference(testScene("heckbert_herf"), {}, {{"classify", "probe"}}).pixels, 150);
}

TEST(Chapter07, MostOfThePictureIsSkipped) {
    ChapterHarness harness(chapter(), testScene("heckbert_herf"));
    harness.scalar("visibility", {512, 512});
    const WorkCounters work = harness.work;
    EXPECT_GT(work.at("pixels_receiving"), 40000);
    EXPECT_GT(work.at("pixels_out_of_reach"), work.at("pixels_receiving") / 3);
    EXPECT_LT(work.at("pixels_supersampled"), work.at("pixels_receiving") / 8);
    EXPECT_EQ(work.at("visibility_tests"), 64 * work.at("pixels_supersampled"));
    harness.set("classify", "probe");
    harness.scalar("visibility", {512, 512});
    EXPECT_LT(harness.work.at("pixels_supersampled"), work.at("pixels_supersampled"));
    harness.set("classify", "none");
    harness.scalar("visibility", {512, 512});
    EXPECT_EQ(harness.work.at("visibility_tests"), 64 * work.at("pixels_receiving"));
}

// Building the minimum-maximum map binds a framebuffer: in the middle of counting, the flags landed in the
// picture, and a frame that skips nothing said that it had done nothing.
TEST(Work, IsCountedInAFrameThatSkipsNothingToo) {
    ChapterHarness all(chapter(), testScene("contact")), none(chapter(), testScene("contact"));
    none.skip = false;
    EXPECT_EQ(picture(all, {}).values, picture(none, {}).values);
    for (const char* counter :
         {"pixels_receiving", "pixels_supersampled", "min_max_lookups", "visibility_tests"}) {
        EXPECT_GT(all.work.at(counter), 0) << counter;
        EXPECT_EQ(none.work.at(counter), all.work.at(counter)) << counter;
    }
}

TEST(Chapter07, RedPixelsAreTheSupersampledOnes) {
    ChapterHarness harness(chapter(), testScene("contact"));
    const FloatImage work = harness.picture("work", size, 3);
    int red = 0;
    for (std::size_t i = 0; i < work.values.size(); i += 3)
        red += work.values[i] > 10.0f * work.values[i + 1] && work.values[i] > 0.0f;
    EXPECT_EQ(red, harness.work.at("pixels_supersampled"));
}

TEST(Chapter07, TheMapIsBuiltOnceForEachShadowMap) {
    ChapterHarness harness(chapter(), testScene("contact"));
    harness.scalar("visibility", size);
    EXPECT_EQ(harness.work.count("min_max_maps_built"), 1u);
    harness.scalar("visibility", size);
    EXPECT_EQ(harness.work.count("min_max_maps_built"), 0u);
    harness.set("radius", "9");
    harness.scalar("visibility", size);
    EXPECT_EQ(harness.work.count("min_max_maps_built"), 1u);
    harness.renderMapsAgain = true;
    harness.scalar("visibility", size);
    EXPECT_EQ(harness.work.count("min_max_maps_built"), 1u);
}

TEST(Chapter07, EsShowsTheSamePicture) {
    FloatImage pictures[2];
    for (const Api api : {Api::desktop, Api::es}) {
        ChapterHarness harness(chapter(), testScene("contact"), api);
        pictures[api == Api::es] = harness.scalar("visibility", size);
    }
    expectImage("07_branching/contact/es", pictures[1], pictures[0], {}, {.meanAbs = 1e-4});
}

/// A probe that is not conservative by one texel, an inverted back-face test, ...: each must change a bit.
TEST(Chapter07, ABrokenShaderIsCaught) {
    struct Mutation {
        const char* what;
        std::string file, from, to;
    };
    const std::string classify = "07_branching/classify.glsl", branching = "07_branching/branching.frag",
                      blocks = "07_branching/min_max_blocks.frag",
                      dilate = "07_branching/min_max_dilate.frag";
    const auto same = [] {
        for (const char* scene : {"fence", "contact", "courtyard"})
            for (const char* radius : {"4", "8", "15.9"})
                if (difference(testScene(scene), {{"radius", radius}}).pixels != 0) return false;
        return true;
    };
    const Mutation mutations[] = {
        {"one block short", dilate, "i < COUNT", "i < COUNT - 1"},
        {"one texel beside", classify, "windowAround(taps.st)", "windowAround(taps.st + 1.0 / 1024.0)"},
        {"back faces only", branching, "onMap && facing", "onMap && !facing"},
        {"farthest taken for nearest", blocks, "smallest(-columns.farthest)", "-smallest(columns.farthest)"},
        {"no allowance for the slope", classify, "z - length(taps.radius * slope) - rounding",
         "z + length(slope)"},
        {"tighter than the disk", classify, "z + excess +", "z - 4.0 * excess +"},
        {"out of reach too early", branching, "any(greaterThan(st, uCasters.zw))",
         "any(greaterThan(st, uCasters.zw - 0.1))"},
    };
    EXPECT_TRUE(same());
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(m.file, m.from, m.to);
        EXPECT_FALSE(same()) << m.what;
    }
}

}  // namespace
}  // namespace penumbra
