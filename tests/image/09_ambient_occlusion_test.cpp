// Chapter 09: how much of the sky is seen, against closed forms and many rays. The chapter's own class is
// tested, so its main.cpp is part of this file.
#define main chapterMain
#include "chapters/09_ambient_occlusion/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "common/scene/light.h"
#include "common/truth/ambient_forms.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/image_check.h"
#include "tests/image/lit_scenes.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/test_scenes.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

using glm::dvec3;
constexpr double pi = std::numbers::pi;
constexpr glm::ivec2 small(64, 48);

ChapterHarness harnessOf(const Scene& scene, const Settings& settings = {}, Api api = Api::desktop) {
    ChapterHarness harness(std::make_unique<AmbientOcclusion>(), scene, api);
    harness.set(settings);
    return harness;
}

/// What the camera sees, as the truth images find it.
PrimaryHits hitsOf(const ChapterHarness& harness, const glm::ivec2& size) {
    const RayTracer tracer(harness.scene);
    return primaryHits(tracer, harness.camera, size);
}

/// `exact(hit)` for every pixel that sees a surface and straddles no silhouette.
TruthImage formOf(const ChapterHarness& harness, const glm::ivec2& size,
                  const std::function<double(const Hit&)>& exact) {
    return surfaceTruth(hitsOf(harness, size), 1, [&](const Hit& hit, int, int, float* value) {
        *value = float(exact(hit));
        return true;
    });
}

// --- rays at each pixel ------------------------------------------------------------------------------------

class Chapter09 : public testing::TestWithParam<std::string> {};

// 64 Owen-scrambled Sobol rays have a root mean square error of 0.018 where one edge crosses the hemisphere
// (half of it hidden; less elsewhere), and the 1024 of the truth 0.0021: together 0.0181, and 15 % on top. It
// grows as the root of the edges' length: the arches and leaves of the courtyard count twice. The mean is
// right: within 3 standard errors over the pixels compared.
TEST_P(Chapter09, RaysFindTheAmbientVisibility) {
    ChapterHarness harness = harnessOf(testScene(GetParam()), {{"samples", "64"}, {"truth-rays", "1024"}});
    if (GetParam() == "room") harness.set("range", "1");
    const double error = 0.0181 * (GetParam() == "courtyard" ? std::sqrt(2.0) : 1.0);
    const TruthImage truth = harness.truth("ambient", small);
    double compared = 0.0;
    for (const float defined : truth.mask.values) compared += defined;
    expectImage("09_ambient_occlusion/" + shortName(GetParam()) + "/ambient",
                harness.scalar("ambient", small), truth.value, truth.mask,
                {.rmse = 1.15 * error, .absBias = 3.0 * error / std::sqrt(compared)});
}
INSTANTIATE_TEST_SUITE_P(Scenes, Chapter09,
                         testing::Values("spheres", "gully", "room", "courtyard", thirdPartyModel),
                         sceneTestName);

/// A floor, and a wall so long and high that it is endless for a range of 0.8 m.
Scene wallScene() {
    return SmallScene()
        .quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})
        .quad({-1, 0, 50}, {0, 60, 0}, {0, 0, -100})
        .flatCamera({0.2, 20, 0}, {0.2, 0, 0}, 1.5)
        .take();
}

struct WallCase {
    const char* weighting;
    const char* falloff;
};

// Beside a wall that counts only within 0.8 m. 1024 rays: 0.0021 (and smoother is better), 15 % on top.
TEST(Chapter09Range, AWallFadesAsItsClosedFormSays) {
    const Scene scene = wallScene();
    for (const WallCase& wall : {WallCase{"cosine", "hard"}, WallCase{"uniform", "hard"},
                                 WallCase{"cosine", "smooth"}, WallCase{"uniform", "smooth"}}) {
        ChapterHarness harness = harnessOf(scene, {{"samples", "1024"},
                                                   {"range", "0.8"},
                                                   {"weighting", wall.weighting},
                                                   {"falloff", wall.falloff}});
        const bool uniform = wall.weighting == std::string("uniform");
        std::atomic<int> beyond = 0;  // counted on all cores
        const glm::ivec2 size(48, 12);
        const TruthImage truth = formOf(harness, size, [&](const Hit& hit) {
            const double distance = hit.position.x + 1.0;
            beyond += distance >= 0.8;
            const AmbientForm form = wall.falloff == std::string("hard")
                                         ? ambientBesideWallWithin(distance, double(0.8f))
                                         : ambientBesideFadingWall(distance, double(0.8f));
            return uniform ? form.uniform : form.cosine;
        });
        const FloatImage actual = harness.scalar("ambient", size);
        expectImage(std::string("09_ambient_occlusion/wall/") + wall.weighting + "_" + wall.falloff, actual,
                    truth.value, truth.mask, {.rmse = 1.15 * 0.0021, .absBias = 3e-4});
        ASSERT_GT(beyond.load(), 100);
        for (std::size_t i = 0; i < actual.values.size(); ++i)
            if (truth.mask.values[i] != 0.0f && truth.value.values[i] == 1.0f) {
                ASSERT_EQ(actual.values[i], 1.0f) << "beyond the range nothing counts";
            }
    }
}

TEST(Chapter09Range, AnOpenPlaneIsExactlyOneHoweverItIsAsked) {
    const Scene scene = turned(floorScene().take(), {1, 0.2, 0.7}, 0.7);
    for (const char* method : {"rays", "vertices", "triangles"})
        for (const char* range : {"0", "0.3"})
            for (const char* weighting : {"cosine", "uniform"})
                for (const bool skip : {true, false}) {
                    ChapterHarness harness = harnessOf(scene, {{"method", method},
                                                               {"range", range},
                                                               {"weighting", weighting},
                                                               {"falloff", skip ? "hard" : "smooth"}});
                    harness.skip = skip;
                    const FloatImage picture = harness.scalar("ambient", {24, 24});
                    const PrimaryHits hits = hitsOf(harness, {24, 24});
                    for (std::size_t i = 0; i < picture.values.size(); ++i)
                        if (hits.hits[i].valid && !hits.straddling[i]) {
                            ASSERT_EQ(picture.values[i], 1.0f) << method << range << weighting;
                        }
                }
}

// --- indoors -----------------------------------------------------------------------------------------------

// The lecture's question: how to do ambient occlusion indoors? All directions end at a wall. Limited, the
// middle of a wall is open: exactly, for no surface within the range rises above its plane.
TEST(Chapter09Indoors, UnlimitedIsBlackAndLimitedIsOneInTheMiddleOfAWall) {
    ChapterHarness harness = harnessOf(testScene("room"), {{"samples", "64"}});
    const PrimaryHits hits = hitsOf(harness, small);
    const FloatImage black = harness.scalar("ambient", small);
    for (const float value : black.values) ASSERT_EQ(value, 0.0f);
    const FloatImage colour = harness.picture("color", small, 3);
    harness.set("range", "0.25");
    for (const char* falloff : {"hard", "smooth"}) {
        harness.set("falloff", falloff);
        const FloatImage limited = harness.scalar("ambient", small);
        // Between the blackboard's frame (up to y = 2.3) and the ceiling (y = 3), away from the side walls.
        int middle = 0;
        float darkest = 1.0f;
        for (std::size_t i = 0; i < limited.values.size(); ++i) {
            const dvec3& p = hits.hits[i].position;
            darkest = std::min(darkest, limited.values[i]);
            if (!hits.hits[i].valid || std::abs(p.z + 3.2) > 1e-3 || p.y < 2.56 || p.y > 2.74) continue;
            if (std::abs(p.x) > 2.0) continue;
            EXPECT_EQ(limited.values[i], 1.0f) << p.x << " " << p.y;
            ++middle;
        }
        EXPECT_GT(middle, 20);
        EXPECT_LT(darkest, 0.7f) << "corners and edges are still occluded";
    }
}

// --- the cloudy day ----------------------------------------------------------------------------------------

/// Mean of the pixels of gully's circular trench at profile angles `from` to `to`, degrees from the bottom.
double trenchMean(const std::vector<Hit>& hits, const FloatImage& picture, double from, double to) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const dvec3& p = hits[i].position;
        if (std::abs(p.x - 3.0) > 0.75 || p.y > -0.01) continue;
        const double angle = std::abs(std::atan2(p.x - 3.0, -p.y)) * 180.0 / pi;
        if (angle < from || angle >= to) continue;
        sum += picture.values[i];
        ++count;
    }
    EXPECT_GE(count, 24);
    return sum / count;
}

/// The camera above gully, moved so that `x` is in the middle, and its picture `height` metres high.
void lookDownAt(ChapterHarness& harness, double x, double height) {
    harness.camera = harness.scene.cameras.at(1);
    harness.camera.position.x = x;
    harness.camera.verticalFov = 2.0 * std::atan(0.5 * height / 60.0);
}

// Langer & Zucker 1994: on a cloudy day brightness follows how much of the sky is seen; but the surface
// normal counts too, and in a round valley it decides: every point of a circular trench sees the rims under
// the same angle, and still the bottom is brightest, A = cos(T/2) cos(t/2). Counting rays (the aperture
// alone) misses it. The mesh is inscribed in the circle with edges of 7.5 degrees: within 0.01.
TEST(Chapter09CloudyDay, ValleysAreBrightestAtTheBottom) {
    ChapterHarness harness = harnessOf(testScene("gully"), {{"samples", "256"}});
    lookDownAt(harness, 3.0, 0.2);
    const glm::ivec2 size(96, 12);
    const PrimaryHits hits = hitsOf(harness, size);
    const FloatImage cosine = harness.scalar("ambient", size);
    harness.set("weighting", "uniform");
    const FloatImage uniform = harness.scalar("ambient", size);
    for (const double angle : {0.0, 20.0, 40.0, 60.0}) {
        const double middle = (angle + 5.0) * pi / 180.0;
        EXPECT_NEAR(trenchMean(hits.hits, cosine, angle, angle + 10.0),
                    ambientInTrench(pi / 2, middle).cosine, 0.01)
            << angle;
        EXPECT_NEAR(trenchMean(hits.hits, uniform, angle, angle + 10.0), 0.5, 0.01) << angle;
    }
    EXPECT_GT(trenchMean(hits.hits, cosine, 0, 10), trenchMean(hits.hits, cosine, 60, 70) + 0.08);
}

// The pit is as bright everywhere as at its bottom: (1 + 0.6)/2.
TEST(Chapter09CloudyDay, ASphericalPitIsFlat) {
    ChapterHarness harness = harnessOf(testScene("gully"), {{"samples", "256"}});
    lookDownAt(harness, 6.5, 1.0);
    for (const float value : harness.scalar("ambient", {20, 20}).values) {
        // 3.5 times the error of 256 rays, 0.0065, among 400 pixels; and the inscribed mesh, 0.01.
        EXPECT_NEAR(value, 0.8f, 0.033f);
    }
}

TEST(Chapter09CloudyDay, TheProfileShowsIt) {
    ChapterHarness harness = harnessOf(testScene("gully"), {{"samples", "64"}});
    harness.camera = harness.scene.cameras.at(1);
    const FloatImage picture = harness.picture("profile", {128, 96}, 3);
    const auto columnHeight = [&](double metres) {  // of the light part, above the foot of the curve
        const int x =
            int(std::lround(64.0 + (metres - 1.0) / (2.0 * 60.0 * std::tan(0.5 * 10.3 * pi / 180.0)) * 96.0));
        int light = 0;
        for (int y = 0; y < 69; ++y) light += picture.at(x, y, 0) > 0.5f;
        return light;
    };
    const int open = columnHeight(1.9), bottom = columnHeight(3.0), side = columnHeight(2.35);
    EXPECT_GT(open, bottom);
    EXPECT_GT(bottom, side);
    EXPECT_NEAR(double(bottom) / open, std::sqrt(0.5), 0.06);
    harness.set("method", "vertices");
    EXPECT_THROW(harness.picture("profile", {16, 16}, 3), UsageError);
}

// --- by the normal alone -----------------------------------------------------------------------------------

TEST(Chapter09Hemisphere, IsTheFractionOfTheSkyAboveTheSurface) {
    for (const char* weighting : {"cosine", "uniform"}) {
        ChapterHarness harness =
            harnessOf(testScene("spheres"), {{"method", "hemisphere"}, {"weighting", weighting}});
        const TruthImage truth = formOf(harness, small, [&](const Hit& hit) {
            const double up = std::clamp(hit.shadingNormal.y, -1.0, 1.0);
            const AmbientForm slope = ambientOnSlope(std::acos(up));
            return weighting[0] == 'c' ? slope.cosine : slope.uniform;
        });
        // A normal interpolated in float and normalised: 1e-5; its angle from the zenith loses half the
        // digits where the surface is level, sqrt(2e-7) / pi.
        expectImage(std::string("09_ambient_occlusion/spheres/hemisphere_") + weighting,
                    harness.scalar("ambient", small), truth.value, truth.mask, {.maxAbs = 2e-4});
    }
}

// It knows nothing of cast shadows: along a plane it is constant, so gullies are as bright as the open
// ground.
TEST(Chapter09Hemisphere, IsBlindToGullies) {
    ChapterHarness harness = harnessOf(testScene("gully"), {{"method", "hemisphere"}});
    harness.camera = harness.scene.cameras.at(1);
    const FloatImage picture = harness.scalar("ambient", small);
    const PrimaryHits hits = hitsOf(harness, small);
    int floor = 0;
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        if (!hits.hits[i].valid || hits.straddling[i] || hits.hits[i].shadingNormal.y < 0.99999) continue;
        EXPECT_NEAR(picture.values[i], 1.0f, 1e-5f);
        floor += hits.hits[i].position.y < -0.9;
    }
    EXPECT_GT(floor, 20) << "the bottom of the rectangular gully";
}

// Gully's ground is put together. While its pieces were closed bodies of their own, a pixel here and there
// along the seams (40 in these pictures) showed a wall inside the ground, which sees half of the sky.
TEST(Chapter09Hemisphere, SeesNoCrackBetweenPiecesOfGround) {
    ChapterHarness harness = harnessOf(testScene("gully"), {{"method", "hemisphere"}});
    Camera& camera = harness.camera;
    camera.verticalFov = 0.1;  // a metre high: nothing else is in sight than level ground and the pit
    for (const dvec3& onSeam : {dvec3(5, 0, -1.5), dvec3(5, 0, 0), dvec3(5, 0, 1.5), dvec3(5, 0, 6),
                                dvec3(6.5, 0, -1.5), dvec3(6.5, 0, 1.5)})
        for (int i = 0; i < 8; ++i) {
            const double angle = 0.3 + 0.25 * pi * i;
            const dvec3 towardsEye(std::cos(angle), 1.5, std::sin(angle));
            camera.forward = -glm::normalize(towardsEye);
            camera.up = glm::normalize(dvec3(0, 1, 0) - camera.forward.y * camera.forward);
            camera.position = onSeam - harness.scene.origin - 10.0 * camera.forward;
            const FloatImage picture = harness.scalar("ambient", {320, 240});
            // The pit is steepest at its rim, (1 + 0.6) / 2.
            const auto cracks = std::count_if(picture.values.begin(), picture.values.end(),
                                              [](float seen) { return !(seen > 0.79f); });
            EXPECT_EQ(cracks, 0) << onSeam.x << ", " << onSeam.z << " from " << angle;
        }
}

// --- light -------------------------------------------------------------------------------------------------

TEST(Chapter09Light, OpenGroundGetsWhatTheSkySends) {
    const Scene scene = floorScene().take();
    for (const auto& [sky, expected] :
         std::map<std::string, double>{{"uniform", 1.0}, {"overcast", 7.0 / 9.0}})
        for (const char* method : {"rays", "hemisphere", "vertices", "bits"}) {
            ChapterHarness harness =
                harnessOf(scene, {{"method", method}, {"sky", sky}, {"samples", "1024"}});
            const FloatImage E = harness.picture("irradiance", {8, 8}, 3);
            const double unit = 1.0 / double(exposure(scene, -1));
            // 1024 directions and a smooth integrand: below 1e-3. Stored directions are not stratified about
            // this normal: 0.5 %.
            EXPECT_NEAR(E.at(3, 3) / (pi * expected * unit), 1.0, method[0] == 'b' ? 5e-3 : 1e-3)
                << sky << method;
            const FloatImage colour = harness.picture("color", {8, 8}, 3);
            EXPECT_NEAR(colour.at(3, 3), 0.8 * E.at(3, 3) / pi, 1e-5 * E.at(3, 3)) << "diffuse 0.8";
        }
}

TEST(Chapter09Light, UnderAUniformSkyIrradianceIsPiTimesAmbientVisibility) {
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"samples", "16"}});
    const double unit = 1.0 / double(exposure(harness.scene, -1));
    const FloatImage A = harness.scalar("ambient", small), E = harness.picture("irradiance", small, 3);
    for (std::size_t i = 0; i < A.values.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(E.values[3 * i + c], pi * unit * double(A.values[i]), 4e-6 * unit);
}

TEST(Chapter09Light, RaysBringAnySkyAndTheSun) {
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"samples", "256"},
                                                              {"truth-rays", "2048"},
                                                              {"sky", "gradient"},
                                                              {"sky-part", "west"},
                                                              {"sun", "on"}});
    const glm::ivec2 size(48, 36);
    const TruthImage truth = harness.truth("irradiance", size);
    const double unit = pi / double(exposure(harness.scene, -1));
    // Half the sky is an edge more: 0.0065 and 0.0013 of the sky's irradiance, 15 % on top. The sun is exact.
    expectImage("09_ambient_occlusion/spheres/irradiance", harness.picture("irradiance", size, 3),
                truth.value, truth.mask, {.rmse = 1.15 * 0.0066 * unit, .absBias = 5e-4 * unit});
}

// --- stored ------------------------------------------------------------------------------------------------

// The gullies' mesh is fine enough for what is between its points to add nothing to the error of 256 rays,
// 0.0065 and 15 % on top; of 256 directions that all points share, 0.0114, and 30 %.
TEST(Chapter09Stored, VerticesAndTrianglesAreNearTheTruth) {
    const std::pair<const char*, double> cases[] = {
        {"vertices", 1.15 * 0.0065}, {"triangles", 1.15 * 0.0065}, {"bits", 1.3 * 0.0114}};
    for (const auto& [method, bound] : cases) {
        ChapterHarness harness =
            harnessOf(testScene("gully"), {{"method", method}, {"samples", "256"}, {"truth-rays", "1024"}});
        const TruthImage truth = harness.truth("ambient", small);
        expectImage(std::string("09_ambient_occlusion/gully/") + method, harness.scalar("ambient", small),
                    truth.value, truth.mask, {.rmse = bound});
    }
}

TEST(Chapter09Stored, BitsAreRelitWithoutARay) {
    const Settings settings{{"method", "bits"}, {"samples", "64"}};
    ChapterHarness harness = harnessOf(testScene("spheres"), settings);
    harness.render("irradiance", small);
    EXPECT_GT(harness.work["rays_traced"], 0);
    for (const auto& [name, value] :
         Settings{{"sky", "overcast"}, {"sky-part", "east"}, {"sun", "on"}, {"sky", "gradient"}}) {
        harness.set(name, value);
        const FloatImage relit = harness.picture("irradiance", small, 3);
        EXPECT_EQ(harness.work["rays_traced"], 0) << name << " " << value;
    }
    const FloatImage relit = harness.picture("irradiance", small, 3);
    ChapterHarness fresh = harnessOf(testScene("spheres"), settings);
    for (const auto& [name, value] : Settings{{"sky", "gradient"}, {"sky-part", "east"}, {"sun", "on"}})
        fresh.set(name, value);
    EXPECT_EQ(differing(relit, fresh.picture("irradiance", small, 3)), 0u);
}

TEST(Chapter09Stored, ASavedSceneIsDrawnAsItWasBaked) {
    const TemporaryFolder folder;
    const std::string file = (folder / "baked.glb").string();
    FloatImage baked;
    {
        ChapterHarness harness =
            harnessOf(testScene("contact"), {{"method", "vertices"}, {"samples", "16"}, {"save", file}});
        baked = harness.scalar("ambient", small);
    }
    const Scene saved = loadGltf(file);
    ChapterHarness harness = harnessOf(saved, {{"method", "stored"}});
    harness.camera = testScene("contact").cameras.at(0);
    const FloatImage stored = harness.scalar("ambient", small);
    EXPECT_EQ(differing(baked, stored), 0u);
    EXPECT_EQ(harness.work["rays_traced"], 0);
}

// --- what is skipped, what repeats, what is refused --------------------------------------------------------

TEST(Chapter09Skips, ChangeNoBit) {
    for (const char* name : {"gully", "contact"})
        for (const char* range : {"0", "0.5"}) {
            ChapterHarness harness = harnessOf(testScene(name), {{"samples", "16"}, {"range", range}});
            const FloatImage skipped = harness.picture("bent-normal", small, 3);
            const std::int64_t traced = harness.work["rays_traced"], saved = harness.work["rays_saved"];
            harness.skip = false;
            const FloatImage all = harness.picture("bent-normal", small, 3);
            EXPECT_EQ(differing(skipped, all), 0u) << name << range;
            EXPECT_GT(saved, 0) << name << range;
            EXPECT_EQ(harness.work["rays_traced"], traced + saved) << name << range;
            EXPECT_EQ(harness.work["rays_saved"], 0);
        }
}

TEST(Chapter09Skips, WhatDidNotChangeIsNotTracedAgain) {
    ChapterHarness harness = harnessOf(testScene("contact"), {{"samples", "4"}});
    const FloatImage first = harness.scalar("ambient", small);
    harness.renderMapsAgain = true;
    EXPECT_EQ(differing(first, harness.scalar("ambient", small)), 0u) << "the same rays again";
    harness.renderMapsAgain = false;
    harness.camera.position.x += 0.1;
    EXPECT_NE(differing(first, harness.scalar("ambient", small)), 0u);
    harness.camera.position.x -= 0.1;
    EXPECT_EQ(differing(first, harness.scalar("ambient", small)), 0u);
}

TEST(Chapter09Skips, APictureInPartsEndsAsTheWhole) {
    ChapterHarness harness = harnessOf(testScene("contact"));
    AmbientOptions options;
    options.samples = 16;
    const glm::ivec2 size(75, 50);  // no multiple of a block
    PixelRays whole(harness.scene), parts(harness.scene);
    whole.update(harness.frame("ambient", size), options, false);
    const std::int64_t traced = harness.work["rays_traced"];
    EXPECT_EQ(harness.work.count("rows_left"), 0u);
    int frames = 0;
    harness.progress = [](double) {
        ADD_FAILURE() << "how far a part is: in a window's log it would begin again and again";
    };
    do {
        parts.update(harness.frame("ambient", size), options, true);
        ASSERT_LT(++frames, 1000);
    } while (harness.work.count("rows_left") > 0);
    EXPECT_EQ(harness.work["rays_traced"], traced);
    for (std::size_t i = 0; i < std::size_t(size.x) * std::size_t(size.y); ++i)
        ASSERT_EQ(whole.visibility(i), parts.visibility(i)) << i;
}

TEST(Chapter09, WhatAMethodCannotDoIsRefused) {
    const Settings wrong[] = {{{"sun", "on"}, {"method", "vertices"}},
                              {{"method", "bits"}, {"samples", "32"}},
                              {{"method", "triangles"}, {"save", "/tmp/never.glb"}},
                              {{"method", "rays"}, {"save", "/tmp/never.glb"}},
                              {{"save", "/tmp/never.txt"}, {"method", "vertices"}},
                              {{"method", "stored"}},
                              {{"method", "vertices"}, {"sky", "no/such.exr"}},
                              {{"sky", "no/such.exr"}}};
    for (const Settings& settings : wrong) {
        ChapterHarness harness = harnessOf(testScene("contact"), {{"samples", "4"}});
        harness.set(settings);
        harness.progress = [](double) { ADD_FAILURE() << "before a bake of minutes, not after it"; };
        EXPECT_THROW(harness.picture("color", {16, 16}, 3), UsageError) << settings[0].first;
    }
    ChapterHarness unwritable = harnessOf(testScene("contact"), {{"method", "vertices"}, {"samples", "4"}});
    unwritable.set("save", "/proc/never.glb");
    unwritable.progress = [](double) { ADD_FAILURE() << "before a bake of minutes, not after it"; };
    EXPECT_THROW(unwritable.picture("color", {16, 16}, 3), Error);
    ChapterHarness harness = harnessOf(testScene("room"), {{"sun", "on"}});
    EXPECT_THROW(harness.picture("color", {16, 16}, 3), UsageError) << "no sun in the class room";
    EXPECT_THROW(harness.truth("work", {16, 16}), UsageError);
}

// --- the exact answers themselves --------------------------------------------------------------------------

// The closed form (cone subtraction of every triangle from a sky of six polygons) and rays agree: 4096 rays,
// 0.00084, 15 % on top.
TEST(Chapter09Truth, ConesAndRaysAgree) {
    ChapterHarness harness = harnessOf(testScene("contact"), {{"samples", "4096"}});
    const glm::ivec2 size(32, 24);
    const TruthImage exact = harness.truth("ambient", size);
    EXPECT_EQ(exact.method, "closed form");
    expectImage("09_ambient_occlusion/contact/ambient", harness.scalar("ambient", size), exact.value,
                exact.mask, {.rmse = 1.15 * 0.00084, .absBias = 3.0 * 0.00084 / std::sqrt(400.0)});
}

TEST(Chapter09Truth, StatesItsStandardError) {
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"truth-rays", "256"}});
    const glm::ivec2 size(32, 24);
    const TruthImage rough = harness.truth("ambient", size);
    harness.set("truth-rays", "4096");
    const TruthImage fine = harness.truth("ambient", size);
    const double error = compareImages(rough.value, fine.value, fine.mask).rmse;
    const std::string key = "standard error ";
    const double stated = std::stod(rough.method.substr(rough.method.find(key) + key.size()));
    EXPECT_NEAR(stated / error, 1.0, 0.25) << rough.method;
}

// --- OpenGL ES ---------------------------------------------------------------------------------------------

TEST(Chapter09, OpenGlEsDrawsTheSame) {
    const std::vector<std::pair<std::string, std::string>> cases{{"hemisphere", "color"},
                                                                 {"rays", "irradiance"},
                                                                 {"vertices", "ambient"},
                                                                 {"triangles", "bent-normal"}};
    std::vector<FloatImage> desktop;
    for (const auto& [method, view] : cases) {
        ChapterHarness harness = harnessOf(testScene("contact"), {{"method", method}, {"samples", "4"}});
        desktop.push_back(harness.picture(view, small, 3));
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ChapterHarness harness =
            harnessOf(testScene("contact"), {{"method", cases[i].first}, {"samples", "4"}}, Api::es);
        const FloatImage es = harness.picture(cases[i].second, small, 3);
        // A pixel or two on a silhouette may fall to the other side; and all else within rounding.
        std::size_t off = 0;
        for (std::size_t k = 0; k < es.values.size(); ++k)
            off += std::abs(es.values[k] - desktop[i].values[k]) > 1e-4f;
        EXPECT_LE(off, 12u) << cases[i].first;
    }
}

// --- that these tests can fail -----------------------------------------------------------------------------

TEST(Chapter09Mutations, AForgottenPiIsNoticed) {
    const MutatedShaders mutated("09_ambient_occlusion/ambient.frag", "value = pi * light.rgb",
                                 "value = light.rgb");
    const Scene scene = floorScene().take();
    ChapterHarness harness = harnessOf(scene, {{"samples", "16"}});
    const FloatImage E = harness.picture("irradiance", {8, 8}, 3);
    EXPECT_GT(std::abs(E.at(3, 3) * double(exposure(scene, -1)) / pi - 1.0), 0.5);
}

TEST(Chapter09Mutations, RaysThatAreCountedAreNotWeighted) {
    const Scene scene = SmallScene()
                            .quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100})
                            .quad({-50, 0, 50}, {0, 90, 0}, {0, 0, -100})
                            .flatCamera({-48, 80, 0}, {-48, 0, 0}, 2.0)
                            .take();
    ChapterHarness harness = harnessOf(scene, {{"samples", "4096"}});
    const auto tilt = [&](const char* weighting) {
        harness.set("weighting", weighting);
        const FloatImage bent = harness.picture("bent-normal", {1, 1}, 3);
        return std::atan2(2.0 * bent.at(0, 0, 0) - 1.0, 2.0 * bent.at(0, 0, 1) - 1.0) * 180.0 / pi;
    };
    // Between two planes both visibilities are 1/2: only the bent normals tell the weightings apart. The
    // floor and the wall end after 50 m and more: they are endless to 1 in 25.
    EXPECT_NEAR(tilt("cosine"), 32.48, 1.0);
    EXPECT_NEAR(tilt("uniform"), 45.0, 1.5);
}

TEST(Chapter09Mutations, TheHemisphereTheOtherWayUpIsNoticed) {
    const MutatedShaders mutated("09_ambient_occlusion/hemisphere.glsl", "0.5 * (1.0 + dot(n, up))",
                                 "0.5 * (1.0 - dot(n, up))");
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"method", "hemisphere"}});
    const TruthImage truth =
        formOf(harness, small, [](const Hit& hit) { return 0.5 * (1.0 + hit.shadingNormal.y); });
    EXPECT_GT(compareImages(harness.scalar("ambient", small), truth.value, truth.mask).maxAbs, 0.9);
}

}  // namespace
}  // namespace penumbra
