// Contact-hardening shadows of 07_branching against the exact area light. The chapter's own class is tested,
// so its main.cpp is part of this file; and its name is part of this file's, so that `./test 07` runs both.
#define main chapterMain
#include "chapters/07_branching/main.cpp"
#undef main

#include <gtest/gtest.h>

#include "tests/image/chapter_harness.h"
#include "tests/image/image_check.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/small_scenes.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(192, 192);

std::unique_ptr<Chapter> chapter() {
    return std::make_unique<Branching>();
}

/// A map coarse enough for the widest penumbra of the scenes to fit into 256 texels.
void harden(ChapterHarness& harness) {
    harness.set("penumbra", "contact-hardening");
    harness.set("map-size", "512");
    harness.set("radius", "256");
}

/// Root mean square error against the exact area light of a fixed kernel of `radius` texels.
double errorOfFixed(const Scene& scene, const char* radius) {
    ChapterHarness harness(chapter(), scene);
    harness.set("map-size", "512");
    harness.set("radius", radius);
    const auto truth = harness.areaLightTruth("visibility", size);
    return compareImages(harness.scalar("visibility", size), truth->value, truth->mask).rmse;
}

/// Measured, with a tenth of reserve. What is left on heckbert_herf is a point's view of the light: a disk
/// for a square, without the cosine of Lambert's law. On contact_panel it is the post, whose blockers are
/// averaged with the wall's.
struct Expected {
    const char* scene;
    ImageBounds bounds;
    double ofBestFixed;  ///< of kernels of 8, 32 and 128 texels
};
const Expected expectations[] = {{"heckbert_herf", {.rmse = 1.1 * 0.0440, .absBias = 1.1 * 0.0292}, 1.0},
                                 {"contact_panel", {.rmse = 1.1 * 0.0757, .absBias = 1.1 * 0.0068}, 0.7}};

TEST(ContactHardening, IsNearerToTheAreaLightThanAFixedKernel) {
    for (const Expected& expected : expectations) {
        const Scene& scene = testScene(expected.scene);
        ChapterHarness harness(chapter(), scene);
        harden(harness);
        const TruthImage truth = harness.truth("visibility", size);
        EXPECT_EQ(truth.against, "area light");
        const ImageError error =
            expectImage(std::string("07_branching/") + expected.scene + "/contact_hardening",
                        harness.scalar("visibility", size), truth.value, truth.mask, expected.bounds);
        for (const char* radius : {"8", "32", "128"})
            EXPECT_LT(error.rmse, expected.ofBestFixed * errorOfFixed(scene, radius)) << radius;
    }
}

/// A square light of 0.8 m, three metres above the ground, and under it the edge of a sheet at `height`.
Scene sheetAt(double height) {
    Scene scene = SmallScene()
                      .quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})
                      .quad({0, height, 3}, {3, 0, 0}, {0, 0, -6})
                      .flatCamera({0, 0.05, 0}, {0, 0, 0}, 2.0)
                      .take();
    Light light;
    light.type = LightType::area;
    light.position = {0, 3, 0};
    light.direction = {0, -1, 0};
    light.area = 0.64;
    scene.lights.push_back(light);
    return scene;
}

/// Width in metres of the ramp from 1 to 0 along the picture's middle rows, from its mean slope half way up.
double rampWidth(double height) {
    constexpr int pixels = 256;
    const Scene scene = sheetAt(height);
    ChapterHarness harness(chapter(), scene);
    harden(harness);
    harness.set("samples", "256");
    const FloatImage visibility = harness.scalar("visibility", glm::ivec2(pixels));
    std::array<double, pixels> profile{};
    for (int x = 0; x < pixels; ++x)
        for (int y = 96; y < 160; ++y) profile[std::size_t(x)] += visibility.at(x, y) / 64.0;
    const auto crossing = [&profile](double level) {
        std::size_t x = 0;
        while (x + 1 < profile.size() && profile[x + 1] > level) ++x;
        const double a = profile[x], b = profile[x + 1];
        return double(x) + (a - level) / (a - b);
    };
    return 2.0 * (crossing(0.25) - crossing(0.75)) * scene.cameras[0].height / pixels;
}

/// Between a quarter and three quarters a disk of radius R has 2 * 0.404 R (diskCoverage), so twice that,
/// where R is the light's, seen past the edge of the sheet: sqrt(0.64 / pi) h / (3 - h).
TEST(ContactHardening, ThePenumbraIsAsWideAsTheLightLooksPastTheBlocker) {
    for (const double height : {0.3, 0.6, 1.0}) {
        const double R = std::sqrt(0.64 / 3.141592653589793) * height / (3.0 - height);
        EXPECT_NEAR(rampWidth(height), 4.0 * 0.404 * R, 0.03 * R) << height;
    }
}

/// The minima bound the search, and without them it is as wide as --radius lets it: then blockers that have
/// nothing to do with the point join the mean.
bool keepsBounds() {
    for (const Expected& expected : expectations) {
        ChapterHarness harness(chapter(), testScene(expected.scene));
        harden(harness);
        const TruthImage truth = harness.truth("visibility", size);
        const ImageError error = compareImages(harness.scalar("visibility", size), truth.value, truth.mask);
        if (error.rmse > expected.bounds.rmse || std::abs(error.bias) > expected.bounds.absBias) return false;
    }
    return true;
}

TEST(ContactHardening, ABrokenShaderIsCaught) {
    const std::string file = "07_branching/contact_hardening.glsl";
    struct Mutation {
        const char* what;
        std::string from, to;
    };
    const Mutation mutations[] = {
        {"receivers searched, not blockers", "uFarther * (z - depth) > 0.0", "uFarther * (z - depth) < 0.0"},
        {"the ratio inverted", "max(receiver - blocker, 0.0) / blocker",
         "blocker / max(receiver - blocker, 1e-3)"},
        {"the light's whole width for its radius", "float radius = uLightRadius",
         "float radius = 2.0 * uLightRadius"},
        {"the minima not used as a bound", "kernelOf(here, nearestBlocker(receiver.str.xy))",
         "vec2(uRadius)"},
        {"window depths averaged, not metres", "blocks * metres(depth)", "blocks * depth"},
        {"sums of blockers", "kernelOf(here, sum / count)", "kernelOf(here, sum)"},
    };
    EXPECT_TRUE(keepsBounds());
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(file, m.from, m.to);
        EXPECT_FALSE(keepsBounds()) << m.what;
    }
}

/// A blocker on the light: the window's mullion hides the courtyard from the window's centre, and what the
/// centre does not see no kernel can bring back. A bound from below: if this were right, the page would be
/// wrong.
TEST(ContactHardening, AWindowsCentreBehindItsMullionSeesNothing) {
    ChapterHarness harness(chapter(), testScene("courtyard"));
    harden(harness);
    harness.set("light", "2");
    const glm::ivec2 small(64, 64);
    const TruthImage truth = harness.truth("visibility", small);
    const ImageError error = compareImages(harness.scalar("visibility", small), truth.value, truth.mask);
    EXPECT_GT(error.rmse, 0.4);
    EXPECT_LT(error.bias, -0.2);
}

TEST(ContactHardening, NeedsAnAreaLight) {
    ChapterHarness harness(chapter(), testScene("contact"));
    harden(harness);
    EXPECT_THROW(harness.scalar("visibility", size), UsageError);
}

}  // namespace
}  // namespace penumbra
