// Chapter 08: the light of many points against the exact light of an area. The chapter's own class is tested,
// so its main.cpp is part of this file.
#define main chapterMain
#include "chapters/08_accumulation/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "chapters/08_accumulation/texture_room.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/earlier_chapters.h"
#include "tests/image/image_check.h"
#include "tests/image/lit_scenes.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/sheet_shadow.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

using glm::dvec3;
ChapterHarness harnessOf(const Scene& scene, const Settings& settings = {}, Api api = Api::desktop) {
    ChapterHarness harness(std::make_unique<Accumulation>(), scene, api);
    harness.set(settings);
    return harness;
}

/// Heckbert & Herf's receiver, straight from above, a texel for each pixel of a picture of 256 x 256.
constexpr glm::ivec2 receiverSize(256, 256);
ChapterHarness receiverHarness(const Settings& settings = {}) {
    ChapterHarness harness = harnessOf(testScene("heckbert_herf"), settings);
    harness.camera = harness.scene.cameras.at(1);
    harness.set("texels-per-metre", "106.66667");
    return harness;
}

/// Root mean square difference of visibility where the exact one is neither 0 nor 1.
double penumbraRmse(const FloatImage& actual, const TruthImage& truth) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < actual.values.size(); ++i) {
        const double exact = truth.value.values[i];
        if (truth.mask.values[i] == 0.0f || exact <= 0.0 || exact >= 1.0) continue;
        sum += std::pow(actual.values[i] - exact, 2.0);
        ++count;
    }
    return std::sqrt(sum / count);
}

double largestDifference(const FloatImage& a, const FloatImage& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        largest = std::max(largest, std::abs(double(a.values[i]) - double(b.values[i])));
    return largest;
}

// --- against the exact light -------------------------------------------------------------------------------

class Chapter08 : public testing::TestWithParam<std::string> {};

// An area light: the samples' error. A point light or sun: shadows are hard, and texels (5 mm, and the pixels
// of a shadow map) are right but for those that an edge crosses.
TEST_P(Chapter08, IsTheExactVisibility) {
    const bool area = GetParam() == "heckbert_herf";
    ChapterHarness harness = harnessOf(testScene(GetParam()), {{"samples", "256"}});
    const glm::ivec2 size(192, 192);
    const TruthImage truth = harness.truth("visibility", size);
    // Reference figures of a penumbra: 0.005 at 256 points (0.0054 for scrambled Sobol points and an edge of
    // any direction). A hard edge is half a texel off at most: 0.05 of the pixels, measured up to 0.026.
    const ImageBounds bounds =
        area ? ImageBounds{.rmse = 0.0054, .absBias = 0.001} : ImageBounds{.meanAbs = 0.05};
    expectImage("08_accumulation/" + shortName(GetParam()) + "/visibility",
                harness.scalar("visibility", size), truth.value, truth.mask, bounds);
}
INSTANTIATE_TEST_SUITE_P(Scenes, Chapter08, testing::ValuesIn(testScenes()), sceneTestName);

// The table's figures for 64, 256 and 1024 points: of scrambled Sobol points within 15 % (they depend on the
// seed), of the golden-ratio lattice, the best up to there, as they are.
TEST(Chapter08Error, FollowsTheReferenceTable) {
    const TruthImage truth = receiverHarness().truth("visibility", receiverSize);
    const std::pair<int, double> table[] = {{64, 0.014}, {256, 0.005}, {1024, 0.0017}};
    for (const char* pattern : {"owen-sobol", "fibonacci"}) {
        std::vector<double> measured;
        for (const auto& [samples, bound] : table) {
            ChapterHarness harness =
                receiverHarness({{"samples", std::to_string(samples)}, {"pattern", pattern}});
            measured.push_back(penumbraRmse(harness.scalar("visibility", receiverSize), truth));
            EXPECT_LE(measured.back(), (pattern[0] == 'f' ? 1.0 : 1.15) * bound) << pattern << samples;
        }
        // Least squares over three points evenly spaced in log N is the slope of the outer two.
        EXPECT_GE(std::log(measured[0] / measured[2]) / std::log(16.0), 0.70) << pattern;
    }
}

// Lit and dark are exact, with eight points as with a thousand.
TEST(Chapter08Error, NoneWhereFullyLitOrDark) {
    const Scene scene = umbraScene();
    for (const char* samples : {"8", "1024"}) {
        ChapterHarness harness = harnessOf(scene, {{"samples", samples}, {"texels-per-metre", "64"}});
        const glm::ivec2 size(128, 128);
        const TruthImage truth = harness.truth("irradiance", size), share = harness.truth("visibility", size);
        const FloatImage actual = harness.picture("irradiance", size, 3);
        int lit = 0, dark = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < share.value.values.size(); ++i) {
            const double exact = truth.value.values[3 * i];
            if (share.mask.values[i] == 0.0f) continue;
            if (share.value.values[i] == 1.0f) {
                worst = std::max(worst, std::abs(actual.values[3 * i] - exact) / exact);
                ++lit;
            } else if (share.value.values[i] == 0.0f) {
                ASSERT_EQ(actual.values[3 * i], 0.0f);
                ++dark;
            }
        }
        EXPECT_LE(worst, 1e-6) << samples;
        EXPECT_GT(lit, 1000);
        EXPECT_GT(dark, 1000);
    }
}

TEST(Chapter08Error, ColorIsTheDiffuseReflection) {
    ChapterHarness harness = receiverHarness({{"method", "exact"}});
    const TruthImage truth = harness.truth("color", receiverSize);
    // Floats all the way, after doubles: a few roundings of values up to 2.
    expectImage("08_accumulation/heckbert_herf/color", harness.picture("color", receiverSize, 3), truth.value,
                truth.mask, {.maxAbs = 4e-6});
}

TEST(Chapter08Error, ExactHasNone) {
    ChapterHarness harness = receiverHarness({{"method", "exact"}});
    const TruthImage truth = harness.truth("visibility", receiverSize);
    // The pixels' centres are the texels' but for rounding; a float for each texel.
    expectImage("08_accumulation/heckbert_herf/exact", harness.scalar("visibility", receiverSize),
                truth.value, truth.mask, {.maxAbs = 2e-6});
}

TEST(Chapter08Error, ShadowMapsAreTheSameLight) {
    ChapterHarness harness = receiverHarness({{"method", "shadow-maps"}, {"samples", "256"}});
    const TruthImage truth = harness.truth("visibility", receiverSize);
    // 0.0054 of the points, and half a map texel (2.4 m / 1024) of each edge in 256, which is less.
    expectImage("08_accumulation/heckbert_herf/shadow-maps", harness.scalar("visibility", receiverSize),
                truth.value, truth.mask, {.rmse = 0.0054, .absBias = 0.001});
}

// A window in the wall of a room, and close under it a sheet over the whole floor: nothing is lit. To the
// floor along the wall the window shines at more than 75 degrees, which no map holds (0.08 of the floor was
// lit, with maps of any size).
TEST(Chapter08Error, WhatNoMapHoldsIsNotTakenForLit) {
    const Scene scene = withAreaLight(floorScene()
                                          .quad({-1, 0.05, 1}, {2, 0, 0}, {0, 0, -1.99})
                                          .quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2})
                                          .quad({-1, 0, -1}, {0, 1, 0}, {0, 0, 2})
                                          .quad({1, 0, -1}, {0, 0, 2}, {0, 1, 0})
                                          .take(),
                                      squareLight({0, 0.5, -0.995}, {0, 0, 1}, 0.3));
    ChapterHarness harness = harnessOf(scene, {{"method", "shadow-maps"}, {"samples", "16"}});
    const glm::ivec2 size(64, 64);
    const TruthImage truth = harness.truth("visibility", size);
    // Half a map texel (7 cm) of light may leak in at the edge of the sheet that is next to the wall.
    expectImage("08_accumulation/beside-the-window", harness.scalar("visibility", size), truth.value,
                truth.mask, {.absBias = 0.02});
}

/// Mean of actual - exact where there is an exact answer.
double signedBias(const FloatImage& actual, const TruthImage& truth) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < actual.values.size(); ++i) {
        if (truth.mask.values[i] == 0.0f) continue;
        sum += double(actual.values[i]) - double(truth.value.values[i]);
        ++count;
    }
    return sum / count;
}

/// A square window with two crossed bars a centimetre in front of it, over a floor.
constexpr double windowSide = 0.8, barWidth = 0.06, barShare = barWidth / windowSide;
Scene barredWindow() {
    const double half = 0.5 * windowSide, z = -1.39, y = 0.5;
    return withAreaLight(floorScene()
                             .quad({-0.5 * barWidth, y - half, z}, {barWidth, 0, 0}, {0, windowSide, 0})
                             .quad({-half, y - 0.5 * barWidth, z}, {windowSide, 0, 0}, {0, barWidth, 0})
                             .take(),
                         squareLight({0, y, -1.4}, {0, 0, 1}, windowSide));
}

/// The picture's bias for each of `seeds` patterns of `points`, and what the points say: the share of the
/// window that the bars hide, less the share of the points.
struct WindowBias {
    std::vector<double> measured, foretold;

    double mean() const {
        return std::accumulate(measured.begin(), measured.end(), 0.0) / double(measured.size());
    }
    double spread() const {
        double sum = 0.0;
        for (const double b : measured) sum += std::pow(b - mean(), 2.0);
        return std::sqrt(sum / double(measured.size() - 1));
    }
};

WindowBias windowBias(int points, int seeds) {
    const Scene scene = barredWindow();
    ChapterHarness harness =
        harnessOf(scene, {{"samples", std::to_string(points)}, {"texels-per-metre", "16"}});
    const glm::ivec2 size(32, 32);
    const TruthImage truth = harness.truth("visibility", size);
    WindowBias bias;
    for (int seed = 0; seed < seeds; ++seed) {
        harness.seed = std::uint32_t(seed);
        bias.measured.push_back(signedBias(harness.scalar("visibility", size), truth));
        double hidden = 0.0;
        for (const LightPoint& p :
             lightPoints(scene.lights[0], points, LightPattern::owenSobol, harness.seed))
            hidden += std::min(std::abs(p.position.x), std::abs(p.position.y - 0.5)) < 0.5 * barWidth;
        bias.foretold.push_back(2.0 * barShare - barShare * barShare - hidden / points);
    }
    return bias;
}

// What hides the same points from every texel errs the same way in all of them, so that a picture of any size
// has a bias: the points' error on the bars. It is none of the method: over patterns it is zero, and with
// more points it goes as quickly as any error of theirs, N^-3/4 (a factor of 8 here).
TEST(Chapter08Error, BarsOnTheWindowBiasAPictureAndNotTheMethod) {
    const int seeds = 48;
    const WindowBias few = windowBias(16, seeds), many = windowBias(256, seeds);
    EXPECT_LT(std::abs(few.mean()), 3.0 * few.spread() / std::sqrt(double(seeds)));
    EXPECT_LT(std::abs(many.mean()), 3.0 * many.spread() / std::sqrt(double(seeds)));
    EXPECT_GT(few.spread(), 4.0 * many.spread());
    EXPECT_LT(many.spread(), 0.01);
    double together = 0.0, alone = 0.0, error = 0.0;
    for (std::size_t i = 0; i < few.measured.size(); ++i) {
        together += few.measured[i] * few.foretold[i];
        alone += few.foretold[i] * few.foretold[i];
    }
    for (std::size_t i = 0; i < few.measured.size(); ++i)
        error += std::pow(few.measured[i] - together / alone * few.foretold[i], 2.0);
    // Foretold by counting points on the bars, which knows nothing of the floor. What is left is that points
    // near the floor weigh more than others.
    EXPECT_NEAR(together / alone, 1.0, 0.2);
    EXPECT_LT(error / seeds, 0.25 * few.spread() * few.spread());
}

// What is no receiver gets Lambert's formula from a shader, in float, cut at the horizon there: 1e-4 of the
// largest, what the arc tangent of a shading language may be off by.
TEST(Chapter08Error, TheShadersClosedFormIsLamberts) {
    for (const auto& light :
         {squareLight({0, 1.5, 0}, {0, -1, 0}, 0.8), squareLight({0, 0.1, -1.4}, {0, 0.2, 1}, 0.8)}) {
        const Scene scene = withAreaLight(floorScene().take(), light);
        ChapterHarness harness = harnessOf(scene, {{"method", "shadow-maps"}, {"samples", "4"}});
        const glm::ivec2 size(64, 64);
        const TruthImage truth = harness.truth("irradiance", size);
        const float largest = *std::max_element(truth.value.values.begin(), truth.value.values.end());
        EXPECT_LT(largestDifference(harness.picture("irradiance", size, 3), truth.value), 1e-4 * largest);
    }
}

// --- the same result by other ways -------------------------------------------------------------------------

struct Case {
    std::string scene;
    Settings settings;
    bool large = false;  ///< its shadows take long to draw
};
const std::vector<Case> cases{
    {"heckbert_herf", {{"samples", "100"}}},
    {"heckbert_herf", {{"samples", "33"}, {"pattern", "fibonacci"}, {"texels-per-metre", "77"}}},
    {"contact", {{"texel-budget", "128"}}},
    {"courtyard", {{"light", "2"}, {"samples", "33"}, {"texel-budget", "64"}, {"minimum-area", "12"}}, true},
    {"knot", {{"light", "1"}, {"samples", "33"}, {"texel-budget", "64"}}, true}};

ChapterHarness harnessOf(const Case& c, const Settings& more) {
    ChapterHarness harness = harnessOf(testScene(c.scene), c.settings);
    harness.set(more);
    harness.set("others", "unshadowed");
    return harness;
}

FloatImage drawn(ChapterHarness& harness, const std::string& view) {
    return harness.picture(view, {160, 160}, 3);
}

// With equal weights visibility is the count of points that are seen, over all. With their own, both add the
// same floats, in another order: 100 additions of at most 2^-24 each.
TEST(Chapter08Slow, MaskAndAccumulateAreTheSameLight) {
    for (const Case& c : cases) {
        ChapterHarness mask = harnessOf(c, {}), stencil = harnessOf(c, {{"masks", "stencil"}}),
                       accumulate = harnessOf(c, {{"method", "accumulate"}});
        const FloatImage light = drawn(mask, "visibility");
        EXPECT_LE(largestDifference(light, drawn(accumulate, "visibility")), 1e-5) << c.scene;
        EXPECT_EQ(differing(light, drawn(stencil, "visibility")), 0u) << c.scene;
        for (ChapterHarness* harness : {&mask, &stencil, &accumulate}) harness->set("weights", "equal");
        const FloatImage counts = drawn(mask, "visibility");
        EXPECT_EQ(differing(counts, drawn(accumulate, "visibility")), 0u) << c.scene;
        EXPECT_EQ(differing(counts, drawn(stencil, "visibility")), 0u) << c.scene;
        if (c.scene == "heckbert_herf") {
            EXPECT_GT(differing(counts, light), 1000u);
        }
    }
}

TEST(Chapter08Slow, SkippingChangesNoBit) {
    for (const Case& c : cases)
        for (const char* method : {"mask", "accumulate", "exact"}) {
            if (std::string(method) == "exact" && c.scene != "heckbert_herf") continue;
            ChapterHarness harness = harnessOf(c, {{"method", method}});
            for (const char* view : {"visibility", "irradiance"}) {
                if (c.large && std::string(view) == "visibility") continue;  // irradiance is made of it
                harness.skip = true;
                const FloatImage skipped = drawn(harness, view);
                harness.skip = false;
                EXPECT_EQ(differing(skipped, drawn(harness, view)), 0u)
                    << c.scene << " " << method << " " << view;
            }
        }
}

TEST(Chapter08Ways, WhatIsSkippedIsCounted) {
    ChapterHarness harness = receiverHarness();
    harness.scalar("visibility", receiverSize);
    EXPECT_EQ(harness.work.at("receivers"),
              2);  // the floor and the top of the triangle, which is not in sight
    EXPECT_EQ(harness.work.at("receivers_unseen"), 1);
    EXPECT_EQ(harness.work.at("receivers_unreached"), 0);
    EXPECT_LT(harness.work.at("texels_mixed"), harness.work.at("texels_in_reach"));
    EXPECT_LT(harness.work.at("texels_in_reach"), harness.work.at("texels"));
    EXPECT_EQ(harness.work.at("occluders_drawn"), 64);  // the triangle, once for each point
    harness.skips().switchOff("receivers-unseen");
    harness.scalar("visibility", receiverSize);
    EXPECT_EQ(harness.work.at("receivers_unreached"), 1);
    harness.skip = false;
    harness.scalar("visibility", receiverSize);
    EXPECT_GT(harness.work.at("occluders_drawn"), 64);
    EXPECT_EQ(harness.work.at("texels_in_reach"), harness.work.at("texels"));
}

// Texels behind the light's plane are dark, whatever is drawn there without need.
TEST(Chapter08Ways, MixedTexelsAreTheSameWithoutSkips) {
    const Scene scene = withAreaLight(floorScene()
                                          .quad({-0.3, 0.2, -0.6}, {0.6, 0, 0}, {0, 0, -0.2})
                                          .quad({-0.3, 0.2, 0.5}, {0.6, 0, 0}, {0, 0, -0.2})
                                          .take(),
                                      squareLight({0, 0.6, 0}, {0, 0, 1}, 0.4));
    const auto mixed = [&](bool skip) {
        ChapterHarness harness = harnessOf(scene, {{"samples", "16"}, {"texels-per-metre", "32"}});
        harness.skip = skip;
        harness.scalar("visibility", {32, 32});
        return harness.work.at("texels_mixed");
    };
    EXPECT_GT(mixed(true), 0);
    EXPECT_EQ(mixed(false), mixed(true));
}

// The camera walks around: what it did not see before is filled then, and kept.
TEST(Chapter08Ways, UnseenReceiversAreFilledWhenTheyAreSeen) {
    const Settings few{{"samples", "8"}, {"texels-per-metre", "20"}, {"others", "unshadowed"}};
    ChapterHarness lazy = harnessOf(testScene("contact_panel"), few),
                   whole = harnessOf(testScene("contact_panel"), few);
    whole.skips().switchOff("receivers-unseen");
    const glm::ivec2 size(96, 96);
    const Camera first = lazy.camera;
    Camera other = first;  // from the other side
    const dvec3 centre = lazy.scene.bounds.centre();
    other.position = {2.0 * centre.x - first.position.x, first.position.y, 2.0 * centre.z - first.position.z};
    other.forward = {-first.forward.x, first.forward.y, -first.forward.z};
    other.up = {-first.up.x, first.up.y, -first.up.z};
    for (const Camera& camera : {first, other, first}) {
        const bool again = lazy.work.count("receivers") > 0 && camera == first;
        lazy.camera = whole.camera = camera;
        const FloatImage picture = lazy.picture("irradiance", size, 3);
        EXPECT_EQ(differing(picture, whole.picture("irradiance", size, 3)), 0u);
        EXPECT_GT(lazy.work.at("receivers_unseen"), 0);
        EXPECT_EQ(lazy.work.at("receivers"), whole.work.at("receivers"));
        EXPECT_EQ(lazy.work.at("occluders_drawn") == 0, again);
    }
    lazy.picture("textures", size, 3);  // shows all of them
    EXPECT_EQ(lazy.work.count("receivers_unseen"), 0u);
}

// A floor with one light above it and one below: each has one receiver, so that nothing but which one it is
// tells what was seen of the one from what is seen of the other. Kept, the floor would stay black from above.
TEST(Chapter08Ways, WhatWasSeenIsNotKeptForOtherReceivers) {
    const Scene scene =
        withAreaLight(withAreaLight(floorScene().take(), squareLight({0, 1, 0}, {0, -1, 0}, 0.5)),
                      squareLight({0, -1, 0}, {0, 1, 0}, 0.5));
    const glm::ivec2 size(32, 32);
    const Settings few{{"samples", "4"}, {"texels-per-metre", "16"}};
    ChapterHarness harness = harnessOf(scene, few);
    harness.set("light", "1");
    harness.render("irradiance", size);
    EXPECT_EQ(harness.work.at("receivers"), 1);
    EXPECT_EQ(harness.work.at("receivers_unseen"), 1);
    harness.set("light", "0");
    const FloatImage above = harness.picture("irradiance", size, 3);
    EXPECT_EQ(harness.work.at("receivers"), 1);
    EXPECT_EQ(harness.work.count("receivers_unseen"), 0u);
    EXPECT_EQ(differing(above, harnessOf(scene, few).picture("irradiance", size, 3)), 0u);
    EXPECT_GT(above.at(16, 16), 0.0f);
}

// Red is what has points that disagree; seen straight from above, a texel is a pixel. The triangle's own
// texture is all blue.
TEST(Chapter08Ways, RedTexelsAreTheMixedOnes) {
    ChapterHarness harness = receiverHarness();
    const FloatImage picture = harness.picture("work", receiverSize, 3);
    int red = 0;
    for (std::size_t i = 0; i < picture.values.size(); i += 3)
        red += picture.values[i] > 5.0f * picture.values[i + 1];
    EXPECT_NEAR(red, double(harness.work.at("texels_mixed")), 2.0 * receiverSize.x);  // the outermost row
    EXPECT_GT(red, 30000);
}

TEST(Chapter08Ways, EsSetsTheSameBits) {
    FloatImage pictures[2];
    for (const Api api : {Api::desktop, Api::es}) {
        ChapterHarness harness =
            harnessOf(testScene("heckbert_herf"), {{"weights", "equal"}, {"samples", "50"}}, api);
        pictures[api == Api::es] = harness.scalar("visibility", {160, 160});
    }
    EXPECT_EQ(differing(pictures[0], pictures[1]), 0u);
}

/// A context in which 32-bit floats can be drawn but not be added up (OpenGL ES without GL_EXT_float_blend).
class WithoutFloatBlend : public Context {
 public:
    explicit WithoutFloatBlend(const Capabilities& whole) {
        capabilities_ = whole;
        capabilities_.floatBlend = false;
    }
    Backend backend() const override { return Backend::automatic; }
};

// Then sums and picture have 11 bits: masks are added up in floats before, so the two sums and their ratio
// are rounded once; 64 additions of accumulate are 64 roundings, 0.007 at most.
TEST(Chapter08Ways, HalfFloatsWhereFloatsCannotBeAddedUp) {
    const std::pair<const char*, double> bounds[] = {
        {"mask", 3 * 0x1p-11}, {"accumulate", 0.007 + 0x1p-11}, {"shadow-maps", 0.007 + 0x1p-11}};
    for (const auto& [method, bound] : bounds) {
        ChapterHarness able = harnessOf(testScene("heckbert_herf"), {{"method", method}}, Api::es),
                       unable = harnessOf(testScene("heckbert_herf"), {{"method", method}}, Api::es);
        const WithoutFloatBlend less(able.capabilities());
        unable.contextInstead = &less;
        const FloatImage floats = able.scalar("visibility", {96, 96}),
                         halves = unable.scalar("visibility", {96, 96});
        EXPECT_LE(largestDifference(halves, floats), bound) << method;
        EXPECT_GT(differing(halves, floats), 1000u) << method;
    }
}

TEST(Chapter08Ways, EightBitsAreNotEnough) {
    const glm::ivec2 size = receiverSize / 2;
    const TruthImage truth = receiverHarness().truth("visibility", size);
    const auto rmse = [&](const char* target, const char* samples) {
        ChapterHarness harness =
            receiverHarness({{"method", "accumulate"}, {"target", target}, {"samples", samples}});
        harness.set("texels-per-metre", "53.333333");
        return penumbraRmse(harness.scalar("visibility", size), truth);
    };
    EXPECT_GT(rmse("8", "256"), 5.0 * rmse("32f", "256"));
    EXPECT_GT(rmse("16f", "1024"), 2.0 * rmse("32f", "1024"));
}

TEST(Chapter08Ways, WhatDoesNotFitIsRefusedBeforehand) {
    ChapterHarness harness =
        harnessOf(testScene("heckbert_herf"),
                  {{"samples", "4096"}, {"texel-budget", "4096"}, {"texels-per-metre", "4000"}});
    EXPECT_THROW(harness.render("visibility", {8, 8}), UsageError);
    harness.set("texel-budget", "1");  // and then goes on
    EXPECT_NO_THROW(harness.render("visibility", {8, 8}));

    Receiver receiver;
    receiver.texels = {100, 10};
    const auto bytes = [&](const char* method, int samples) {
        AccumulationOptions options;
        options.method = method;
        options.samples = samples;
        return textureBytes(options, testScene("heckbert_herf"), {receiver});
    };
    EXPECT_EQ(bytes("mask", 4096) - bytes("mask", 32), 1000 * (4096 - 32) / 8);
    EXPECT_EQ(bytes("mask", 33), bytes("mask", 64));
    EXPECT_EQ(bytes("accumulate", 4096), bytes("accumulate", 1));
}

// --- the sum, point by point -------------------------------------------------------------------------------

// Every point counts, with its own bit and weight: 250 of them are two passes of resolve.frag, and a last
// word that is not full. One point too many or of twice its weight is off by 1/250, rounding by 3e-5.
TEST(Chapter08Points, ATexelSeesTheShareThatItsLightPointsSay) {
    constexpr int side = 64;  // a texel for each pixel of the floor
    const std::vector<std::vector<dvec3>> sheets{
        {{-0.5, 0.5, -0.4}, {0.1, 0.5, -0.4}, {0.1, 0.5, 0.2}, {-0.5, 0.5, 0.2}},
        {{0.0, 0.2, -0.1}, {0.6, 0.4, -0.1}, {0.6, 0.4, 0.5}, {0.0, 0.2, 0.5}}};
    SmallScene floor = floorScene();
    for (const auto& sheet : sheets) floor.quad(sheet[0], sheet[1] - sheet[0], sheet[3] - sheet[0]);
    const Scene scene = withAreaLight(floor.take(), squareLight({0.1, 1.1, -0.2}, {0.2, -1, 0.3}, 0.5));
    const Light& light = scene.lights[0];
    const std::vector<Hit> hits = primaryHits(RayTracer(scene), scene.cameras[0], {side, side}).hits;
    const Settings common{{"pattern", "owen-sobol"}, {"target", "32f"}, {"texels-per-metre", "32"}};
    for (const int samples : {50, 250}) {
        std::vector<PointShadows> points;
        for (const LightPoint& p : lightPoints(light, samples, LightPattern::owenSobol, 0)) {
            points.push_back({p.position, {}});
            for (const auto& sheet : sheets) points.back().sheets.emplace_back(sheet, p.position);
        }
        for (const Settings& way : {Settings{{"method", "mask"}}, Settings{{"masks", "stencil"}},
                                    Settings{{"method", "accumulate"}}, Settings{{"weights", "equal"}}}) {
            ChapterHarness harness = harnessOf(scene, common);
            harness.set(way);
            harness.set("samples", std::to_string(samples));
            const FloatImage actual = harness.scalar("visibility", {side, side});
            int halfShadow = 0;
            double worst = 0.0;
            for (std::size_t i = 0; i < actual.values.size(); ++i) {
                // An edge is drawn to 1/256 of a texel.
                const double expected = shareSeen(points, light.direction, hits[i].position,
                                                  0.02 * 2.0 / side, way[0].second == "equal");
                if (expected < 0.0) continue;
                halfShadow += expected > 0.0 && expected < 1.0;
                worst = std::max(worst, std::abs(actual.values[i] - expected));
            }
            // Sums of `samples` floats, each of a dozen roundings, and their ratio.
            EXPECT_LE(worst, (samples + 32) * 0x1p-23) << way[0].second << samples;
            EXPECT_GT(halfShadow, 300) << way[0].second << samples;
        }
    }
}

// --- stored visibility -------------------------------------------------------------------------------------

TEST(Chapter08Relight, PartsOfTheLightNeedNoOccluder) {
    ChapterHarness kept = receiverHarness();
    kept.picture("irradiance", receiverSize, 3);
    for (const char* part : {"left", "quarter", "right", "all"}) {
        kept.set("light-part", part);
        const FloatImage relit = kept.picture("irradiance", receiverSize, 3);
        EXPECT_EQ(kept.work.at("occluders_drawn"), 0) << part;
        EXPECT_EQ(kept.work.at("relit"), 1) << part;
        ChapterHarness fresh = receiverHarness({{"light-part", part}});
        EXPECT_EQ(differing(relit, fresh.picture("irradiance", receiverSize, 3)), 0u) << part;
        const TruthImage truth = fresh.truth("irradiance", receiverSize);
        // A half has 32 of the 64 points, a quarter 16: 0.040 of the unoccluded 1.85 at most.
        expectImage(std::string("08_accumulation/relit/") + part, relit, truth.value, truth.mask,
                    {.rmse = 0.040 * 1.85});
    }
}

TEST(Chapter08Relight, IntensityIsAFactor) {
    ChapterHarness harness = receiverHarness();
    const FloatImage once = harness.picture("irradiance", receiverSize, 3);
    harness.set("intensity", "2");
    const FloatImage twice = harness.picture("irradiance", receiverSize, 3);
    EXPECT_EQ(harness.work.at("occluders_drawn"), 0);
    EXPECT_EQ(harness.work.at("relit"), 1);
    for (std::size_t i = 0; i < once.values.size(); ++i) ASSERT_EQ(twice.values[i], 2.0f * once.values[i]);
    harness.picture("irradiance", receiverSize, 3);
    EXPECT_EQ(harness.work.count("relit"), 0u);  // nothing changed
}

// --- relations ---------------------------------------------------------------------------------------------

// One point in the middle of the light is chapter 03's lamp. Each has its own texels (5 mm on the receiver,
// and a 1024 map), so they differ along the shadow's outline alone: 5.2 m of it in 2.4 x 2.4 m, half a texel
// of either.
TEST(Chapter08Relation, OneSampleIsTheHardShadowOfChapter03) {
    ChapterHarness one =
        receiverHarness({{"samples", "1"}, {"pattern", "regular"}, {"texels-per-metre", "200"}});
    const FloatImage actual = one.scalar("visibility", receiverSize);
    const FloatImage hard = visibilityOfChapter03(one, receiverSize, BiasMethod::slope);
    const double outline = 5.2 / 2.4 * 256;  // pixels
    double sum = 0.0;
    for (std::size_t i = 0; i < hard.values.size(); ++i) sum += std::abs(actual.values[i] - hard.values[i]);
    EXPECT_LT(sum, 0.6 * outline);
    EXPECT_GT(std::count(hard.values.begin(), hard.values.end(), 0.0f), 5000);
}

TEST(Chapter08Relation, SeveralLightsAddUp) {
    const Scene& scene = testScene("room");
    const glm::ivec2 size(96, 96);
    const Settings few{
        {"samples", "8"}, {"others", "unshadowed"}, {"texels-per-metre", "16"}, {"minimum-area", "0.5"}};
    const auto by = [&](const char* light) {
        ChapterHarness harness = harnessOf(scene, few);
        harness.set("light", light);
        return harness.picture("irradiance", size, 3);
    };
    const FloatImage first = by("0"), second = by("1"), both = by("-1");
    double largest = 0.0;
    for (const float v : both.values) largest = std::max(largest, double(v));
    // Where two surfaces coincide, which of them is seen is a matter of the order: a receiver of the second
    // light is drawn after what is no receiver of the first. A pixel or two in the gaps of the floor boards.
    int compared = 0, wrong = 0;
    for (std::size_t i = 0; i < both.values.size(); ++i) {
        wrong += std::abs(double(first.values[i]) + second.values[i] - both.values[i]) > 1e-5 * largest;
        compared += both.values[i] > 0.0f;
    }
    EXPECT_LE(wrong, 9);
    EXPECT_GT(compared, 1000);
}

// --- cases that must be right ------------------------------------------------------------------------------

/// Tests a picture of the floor's irradiance against the exact one: root mean square error over the largest.
void expectExactLight(const std::string& name, const Scene& scene, const std::string& method, double bound) {
    ChapterHarness harness =
        harnessOf(scene, {{"method", method}, {"samples", "1024"}, {"texels-per-metre", "64"}});
    const glm::ivec2 size(128, 128);
    const TruthImage truth = harness.truth("irradiance", size);
    const float largest = *std::max_element(truth.value.values.begin(), truth.value.values.end());
    expectImage("08_accumulation/cases/" + method + "/" + name, harness.picture("irradiance", size, 3),
                truth.value, truth.mask, {.rmse = bound * std::max(largest, 1e-3f)});
}

// A thousand points are off by 0.0017 of the unoccluded light in a penumbra; edges that touch the floor are
// hard, and wrong in the half texel beside them.
TEST(Chapter08Cases, ManyPointsAreTheExactLight) {
    for (const HardCase& c : hardCases()) expectExactLight(c.name, c.scene, "mask", 0.004);
}

// A float for each texel, of pixels whose centres are the texels' but for rounding.
TEST(Chapter08Cases, ExactIsTheExactLight) {
    for (const HardCase& c : hardCases()) expectExactLight(c.name, c.scene, "exact", 1e-3);
}

TEST(Chapter08Cases, ATwoSidedLightIsTwoLights) {
    const auto make = [] {
        return SmallScene()
            .quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})
            .quad({-1, 3, -1}, {2, 0, 0}, {0, 0, 2})
            .quad({-0.2, 0.6, 0.2}, {0.4, 0, 0}, {0, 0, -0.4})
            .camera({0, 1.5, 4.5}, {0, 1.5, 0}, 1.0)
            .take();
    };
    const auto down = squareLight({0, 1.5, 0}, {0, -1, 0}, 0.8),
               up = squareLight({0, 1.5, 0}, {0, 1, 0}, 0.8);
    const Scene scene = withAreaLight(withAreaLight(make(), down), up);
    ChapterHarness harness = harnessOf(scene, {{"light", "-1"}, {"samples", "1024"}});
    const TruthImage truth = harness.truth("irradiance", {128, 128});
    // 0.0017 of the largest, and the pixels are not the texels.
    expectImage("08_accumulation/cases/two-sided", harness.picture("irradiance", {128, 128}, 3), truth.value,
                truth.mask, {.rmse = 0.02, .absBias = 0.002});
}

// A hidden-line scene does not know which way is up: turned by an odd angle, the same light.
TEST(Chapter08Cases, TurnedByAnOddAngle) {
    const dvec3 axis(0.3, 0.8, -0.5);
    const double angle = 37.3 * std::numbers::pi / 180.0;
    const Scene stairs = withAreaLight(floorScene()
                                           .box({-0.6, 0, -0.5}, {-0.2, 0.2, 0.5})
                                           .box({-0.2, 0, -0.5}, {0.1, 0.4, 0.5})
                                           .quad({0.3, 0.2, -0.6}, {0, 0, 1.1}, {0.3, 0.4, 0})
                                           .take(),
                                       squareLight({0.9, 1.4, 0.3}, {-0.6, -1, -0.2}, 0.6));
    const Scene louvres = withAreaLight(floorScene()
                                            .quad({-0.7, 0.5, -0.5}, {0.2, 0.1, 0}, {0, 0, 1})
                                            .quad({-0.3, 0.5, -0.5}, {0.2, 0.1, 0}, {0, 0, 1})
                                            .quad({0.1, 0.5, -0.5}, {0.2, 0.1, 0}, {0, 0, 1})
                                            .quad({0.5, 0.5, -0.5}, {0.2, 0.1, 0}, {0, 0, 1})
                                            .take(),
                                        squareLight({-0.4, 1.6, 0.1}, {0.2, -1, 0}, 0.5));
    expectExactLight("stairs turned", turned(stairs, axis, angle), "mask", 0.004);
    expectExactLight("louvres turned", turned(louvres, axis, angle), "mask", 0.004);
    expectExactLight("louvres turned", turned(louvres, axis, angle), "exact", 1e-3);
}

// --- that the bounds can fail ------------------------------------------------------------------------------

double errorOf(const Scene& scene, bool skip) {
    ChapterHarness harness = harnessOf(scene, {{"samples", "1024"}, {"texels-per-metre", "64"}});
    harness.skip = skip;
    const glm::ivec2 size(128, 128);
    return penumbraRmse(harness.scalar("visibility", size), harness.truth("visibility", size));
}

TEST(Chapter08Mutations, ABrokenShaderIsCaught) {
    const std::string weight = "08_accumulation/weight.glsl", project = "08_accumulation/project.vert",
                      classify = "08_accumulation/classify.frag", resolve = "08_accumulation/resolve.frag",
                      lookUp = "08_accumulation/received.frag";
    struct Mutation {
        const char* what;
        std::string file, from, to;
        bool skip = true;
    };
    const Mutation mutations[] = {
        {"no 1/r^2", weight, "lightPoint.w / (r2 * r2)", "lightPoint.w / r2"},
        {"no cosine", weight, "lightPoint.w / (r2 * r2)", "lightPoint.w / sqrt(lightPoint.z) / (r2 * r2)"},
        {"wrong Jacobian", weight, "lightPoint.w / (r2 * r2)", "lightPoint.w / (r2 * sqrt(r2))"},
        // at 0.6 of the way, where z is -w
        {"pyramid cut too far from the light", project, "dot(aClipZ, p), dot",
         "0.5 * dot(aClipW, p) - 0.9, dot"},
        // (skipping would not even draw the receiver's own triangles)
        {"receiver shadows itself", project, "dot(aClipZ, p), dot", "0.99 * dot(aClipZ, p), dot", false},
        {"bits off by one", resolve, "1u << uint(i)", "2u << uint(i)"},
        {"mixed taken for lit", classify, "any(notEqual(min(hidden, 1u) & min(seen, 1u), uvec4(0u)))",
         "false"},
        {"the neighbour's texel", resolve, "vec4(0.0, 1.0, 2.0, 3.0)", "vec4(3.0, 2.0, 1.0, 0.0)"},
        {"half a texel off", lookUp, "texel - 0.5, cell", "texel, cell"},
        {"upside down", lookUp, "dot(uTexelX, p), dot(uTexelY, p)",
         "dot(uTexelX, p), float(textureSize(uReceived, 0).y) - dot(uTexelY, p)"},
    };
    const Scene scene = mutationScene();
    // The bound of a thousand points, and a little for a light so near that weights differ by a factor of 40.
    constexpr double bound = 0.003;
    EXPECT_LT(errorOf(scene, true), bound);
    EXPECT_LT(errorOf(scene, false), bound);
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(m.file, m.from, m.to);
        EXPECT_GT(errorOf(scene, m.skip), bound) << m.what;
    }
}

// What is behind the light must not be projected through it.
TEST(Chapter08Mutations, WithoutItsNearPlaneTheLightShadowsWhatIsBehindIt) {
    const Scene scene = withAreaLight(floorScene()
                                          .quad({-0.3, 1.9, 0.3}, {0.6, 0, 0}, {0, 0, -0.6})
                                          .quad({-0.2, 0.4, 0.2}, {0.3, 0, 0}, {0, 0, -0.3})
                                          .take(),
                                      squareLight({0, 1.5, 0}, {0, -1, 0}, 0.4));
    ChapterHarness harness = harnessOf(scene, {{"samples", "256"}});
    harness.skip = false;  // skipping would leave it out before
    const TruthImage truth = harness.truth("visibility", {128, 128});
    EXPECT_LT(penumbraRmse(harness.scalar("visibility", {128, 128}), truth), 0.01);
    const MutatedShaders mutated("08_accumulation/project.vert", "dot(aClipZ, p), dot", "0.0, dot");
    ChapterHarness broken = harnessOf(scene, {{"samples", "256"}});
    broken.skip = false;
    EXPECT_GT(penumbraRmse(broken.scalar("visibility", {128, 128}), truth), 0.1);
}

}  // namespace
}  // namespace penumbra
