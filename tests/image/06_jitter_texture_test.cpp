// Chapter 06: the mean of chapter 05, with errors that neighbours do not share. The chapter's own class is
// tested, so its main.cpp is part of this file.
#define main chapter05Main
#include "chapters/05_jittered_disk/main.cpp"
#undef main
#define main chapterMain
#include "chapters/06_jitter_texture/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <cmath>

#include "tests/image/chapter_harness.h"
#include "tests/image/edge_scene.h"
#include "tests/image/image_check.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(192, 192);

std::unique_ptr<Chapter> chapter() {
    return std::make_unique<JitterTextureChapter>();
}

FloatImage edgePicture(std::unique_ptr<Chapter> drawn, const EdgeScene& edge, const Settings& settings) {
    ChapterHarness harness(std::move(drawn), edge.scene);
    harness.set("map-size", "512");
    harness.set("radius", "64");
    harness.set(settings);
    return harness.scalar("visibility", size);
}

/// Minus chapter 05 with 1024 taps, whose own error is a tenth of what is looked for; 0 outside the penumbra.
/// The closed form would not do: the map's texels turn the edge into a staircase, the same for all pixels.
std::vector<double> edgeErrors(const EdgeScene& edge, const Settings& settings) {
    const FloatImage visibility = edgePicture(chapter(), edge, settings);
    const FloatImage mean =
        edgePicture(std::make_unique<JitteredDisk>(), edge, {{"samples", "1024"}, {"pattern", "sobol"}});
    std::vector<double> errors;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            errors.push_back(std::abs(edge.distance(x, y, size.x)) < 60.0
                                 ? double(visibility.at(x, y)) - double(mean.at(x, y))
                                 : 0.0);
    return errors;
}

double rms(const std::vector<double>& errors) {
    double sum = 0.0, count = 0.0;
    for (const double e : errors) {
        sum += e * e;
        count += e != 0.0;
    }
    return std::sqrt(sum / count);
}

/// Mean of each 3 x 3 neighbourhood.
std::vector<double> boxed(const std::vector<double>& errors) {
    std::vector<double> result(errors.size(), 0.0);
    for (int y = 1; y + 1 < size.y; ++y)
        for (int x = 1; x + 1 < size.x; ++x) {
            bool inside = true;
            double sum = 0.0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const double e = errors[(y + j) * size.x + x + i];
                    inside = inside && e != 0.0;
                    sum += e;
                }
            if (inside) result[y * size.x + x] = sum / 9.0;
        }
    return result;
}

/// Correlation of the errors of horizontal neighbours.
double neighbourCorrelation(const std::vector<double>& errors) {
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
        if (errors[i] == 0.0 || errors[i + 1] == 0.0) continue;
        product += errors[i] * errors[i + 1];
        square += errors[i] * errors[i];
    }
    return product / square;
}

TEST(Chapter06, MeanIsThatOfChapter05) {
    // z-test over 6 edges: 4 standard errors, a false alarm once in 16 000 runs for independent pixels. The
    // patterns repeat with the tile, so only 256 patterns are independent for each edge.
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int k = 0; k < 6; ++k) {
        const EdgeScene edge(0.2 + 0.5 * k, 512);
        for (const double e : edgeErrors(edge, {{"order", "white"}, {"tile", "64"}, {"samples", "16"}})) {
            if (e == 0.0) continue;
            sum += e;
            squares += e * e;
            ++count;
        }
    }
    ASSERT_GT(count, 50000);
    const double standardError = std::sqrt(squares) / count;
    EXPECT_LT(std::abs(sum / count), 4.0 * standardError);
}

TEST(Chapter06, NeighboursAreUncorrelatedInWhiteAndOpposedInBlue) {
    const EdgeScene edge(0.3, 512);
    const auto white = edgeErrors(edge, {{"order", "white"}, {"tile", "64"}});
    const auto blue = edgeErrors(edge, {{"order", "blue"}, {"tile", "64"}});
    EXPECT_LT(std::abs(neighbourCorrelation(white)), 0.05);
    EXPECT_LT(neighbourCorrelation(blue), -0.02);
}

/// Root mean square over four edges, alone and after a box of 3 x 3 pixels.
glm::dvec2 rmsAndBoxed(const std::string& order) {
    glm::dvec2 sum(0.0);
    for (int k = 0; k < 4; ++k) {
        const auto errors = edgeErrors(EdgeScene(0.2 + 0.4 * k, 512), {{"order", order}});
        sum += glm::dvec2(rms(errors), rms(boxed(errors))) / 4.0;
    }
    return sum;
}

TEST(Chapter06, OrderLowersTheErrorOfABoxAndNotOfAPixel) {
    const glm::dvec2 white = rmsAndBoxed("white");
    EXPECT_LT(white.x, 1.15 * 0.022);  // the table's figure for 64 jittered samples, polar
    const glm::dvec2 blue = rmsAndBoxed("blue");
    EXPECT_NEAR(blue.x / white.x, 1.0, 0.1);
    EXPECT_LT(blue.y, 0.8 * white.y);  // measured 0.0054 and 0.0076
}

TEST(Chapter06, EveryLayoutIsTheSamePattern) {
    ChapterHarness harness(chapter(), testScene("contact"));
    const FloatImage packed = harness.scalar("visibility", size);
    harness.set("layout", "snorm8");
    // One byte is one byte: only the rounding of its float differs, which moves a tap across the border of a
    // texel now and then.
    expectImage("06_jitter_texture/contact/snorm8", harness.scalar("visibility", size), packed, {},
                {.meanAbs = 1e-4});
    harness.set("layout", "packed16");
    expectImage("06_jitter_texture/contact/packed16", harness.scalar("visibility", size), packed, {},
                {.meanAbs = 2e-3});
}

class AgainstTruth : public testing::TestWithParam<std::string> {};

TEST_P(AgainstTruth, IsTheFilter) {
    for (const char* method : {"texture", "rotation"}) {
        ChapterHarness harness(chapter(), testScene(GetParam()));
        harness.set("method", method);
        const TruthImage truth = harness.truth("visibility", size);
        expectImage("06_jitter_texture/" + shortName(GetParam()) + "/" + method,
                    harness.scalar("visibility", size), truth.value, truth.mask,
                    {.rmse = GetParam() == "heckbert_herf" ? 0.02 : 0.12, .absBias = 0.02});
    }
}
INSTANTIATE_TEST_SUITE_P(Chapter06, AgainstTruth,
                         testing::Values("heckbert_herf", "contact", "courtyard", thirdPartyModel),
                         sceneTestName);

TEST(Chapter06, EsShowsTheSamePicture) {
    FloatImage pictures[2];
    for (const Api api : {Api::desktop, Api::es}) {
        ChapterHarness harness(chapter(), testScene("contact"), api);
        pictures[api == Api::es] = harness.scalar("visibility", size);
    }
    expectImage("06_jitter_texture/contact/es", pictures[1], pictures[0], {}, {.meanAbs = 1e-4});
}

TEST(Chapter06, SkippingChangesNoBit) {
    ChapterHarness harness(chapter(), testScene("courtyard"));
    const FloatImage skipped = harness.picture("color", size, 3);
    harness.skip = false;
    expectImage("06_jitter_texture/courtyard/skip", harness.picture("color", size, 3), skipped, {},
                {.maxAbs = 0.0});
}

/// Each broken shader must break a bound that the true one keeps.
TEST(Chapter06, ABrokenShaderIsCaught) {
    const std::string jitter = "06_jitter_texture/jitter.glsl";
    struct Mutation {
        const char* what;
        std::string from, to;
    };
    const auto keepsBounds = [] {
        const EdgeScene edge(0.3, 512);
        const auto errors = edgeErrors(edge, {{"tile", "64"}});
        double sum = 0.0, count = 0.0;
        for (const double e : errors) sum += e, count += e != 0.0;
        return rms(errors) < 0.03 && std::abs(sum / count) < 2e-3 &&
               std::abs(neighbourCorrelation(errors)) < 0.3;
    };
    const Mutation mutations[] = {
        {"the same column for all pixels", "ivec2(mod(gl_FragCoord.xy, vec2(textureSize(uJitter, 0).xy)))",
         "ivec2(0)"},
        {"unsigned bytes", "ivec4(word << 24, word << 16, word << 8, word) >> 24)",
         "ivec4(uvec4(word << 24, word << 16, word << 8, word) >> 24))"},
        {"radius a tenth short", "receiver.str.xy, radius / mapSize,",
         "receiver.str.xy, 0.9 * radius / mapSize,"},
        {"one word of four", "litOfTwo(taps, words.x) + litOfTwo(taps, words.y) + litOfTwo(taps, words.z)",
         "3.0 * litOfTwo(taps, words.x)"},
    };
    EXPECT_TRUE(keepsBounds());
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(jitter, m.from, m.to);
        EXPECT_FALSE(keepsBounds()) << m.what;
    }
}

}  // namespace
}  // namespace penumbra
