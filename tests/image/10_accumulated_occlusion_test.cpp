// Chapter 10: shadow maps of the sky against rays. The chapter's own class is tested, so its main.cpp is part
// of this file.
#define main chapterMain
#include "chapters/10_accumulated_occlusion/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "chapters/09_ambient_occlusion/bake_file.h"
#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/10_accumulated_occlusion/direction_batches.h"
#include "common/image/compare.h"
#include "common/scene/light.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/earlier_chapters.h"
#include "tests/image/image_check.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/small_scenes.h"
#include "tests/image/test_scenes.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

using glm::dvec3;
constexpr glm::ivec2 small(64, 48);

ChapterHarness harnessOf(const Scene& scene, const Settings& settings = {}, Api api = Api::desktop) {
    ChapterHarness harness(std::make_unique<AccumulatedOcclusionChapter>(), scene, api);
    harness.set("truth-rays", "1024");
    harness.set(settings);
    return harness;
}

/// Error of N Fibonacci directions where one sphere hides a part of the sky and normals look everywhere
/// (measured over 600 trials), and 1.3 times that: edges in a scene are longer or shorter.
double tableError(int directions) {
    const std::map<int, double> table{{4, 0.34}, {32, 0.056}, {64, 0.033}, {128, 0.0195}, {512, 0.0068}};
    return 1.3 * table.at(directions);
}

/// Together with the noise of 1024 rays.
double withRays(double error) {
    return std::hypot(error, 0.0038);
}

ImageError errorOf(const FloatImage& actual, const TruthImage& truth) {
    return compareImages(actual, truth.value, truth.mask);
}

double rmseOf(const FloatImage& actual, const TruthImage& truth) {
    return errorOf(actual, truth).rmse;
}

/// A floor, with or without a box on it, seen from above.
Scene floorScene(bool withBox) {
    SmallScene scene;
    scene.quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    if (withBox) scene.box({-0.5, 0, -0.5}, {0.5, 1, 0.5});
    return scene.light(LightType::directional, {}, {0, -1, 0}).camera({0.3, 5, 3}, {0, 0, 0}).take();
}

// --- against rays ------------------------------------------------------------------------------------------

class Chapter10 : public testing::TestWithParam<std::string> {};

// The mean is off by less than 0.003: neither acne (darker) nor leaks (brighter). The error grows as the root
// of the edges' length in the sky: the arches and leaves of the courtyard count twice, as in chapter 09.
TEST_P(Chapter10, FindsTheAmbientVisibility) {
    // The engine would take as long as all the rest: half as many.
    const int directions = GetParam() == thirdPartyModel ? 64 : 128;
    ChapterHarness harness =
        harnessOf(testScene(GetParam()), {{"samples", std::to_string(directions)}, {"map-size", "1024"}});
    const TruthImage truth = harness.truth("ambient", small);
    const double edges = GetParam() == "courtyard" ? std::sqrt(2.0) : 1.0;
    expectImage("10_accumulated_occlusion/" + shortName(GetParam()) + "/ambient",
                harness.scalar("ambient", small), truth.value, truth.mask,
                {.rmse = withRays(edges * tableError(directions)), .absBias = 0.003});
}
INSTANTIATE_TEST_SUITE_P(Scenes, Chapter10,
                         testing::Values("spheres", "gully", "room", "courtyard", thirdPartyModel),
                         sceneTestName);

TEST(Chapter10Error, FallsAsTheTableSays) {
    for (const int directions : {4, 32, 512}) {
        ChapterHarness harness =
            harnessOf(testScene("spheres"), {{"samples", std::to_string(directions)}, {"map-size", "1024"}});
        const TruthImage truth = harness.truth("ambient", small);
        EXPECT_LE(rmseOf(harness.scalar("ambient", small), truth), withRays(tableError(directions)))
            << directions;
    }
}

// The table says 2.6 times as much for random directions; where half of the picture is open ground, less.
TEST(Chapter10Error, RandomDirectionsHaveMore) {
    std::map<std::string, double> errors;
    for (const char* pattern : {"fibonacci", "owen-sobol", "random"}) {
        ChapterHarness harness =
            harnessOf(testScene("spheres"), {{"samples", "64"}, {"directions", pattern}});
        errors[pattern] = rmseOf(harness.scalar("ambient", small), harness.truth("ambient", small));
    }
    EXPECT_LE(errors["fibonacci"], withRays(tableError(64)));
    EXPECT_LE(errors["owen-sobol"], withRays(1.5 * tableError(64)));
    EXPECT_GT(errors["random"], 1.3 * errors["fibonacci"]);
}

TEST(Chapter10Error, EveryDepthFormatWillDo) {
    for (const char* format : {"16", "24", "32f"}) {
        ChapterHarness harness =
            harnessOf(testScene("spheres"), {{"samples", "64"}, {"depth-format", format}});
        const TruthImage truth = harness.truth("ambient", small);
        expectImage(std::string("10_accumulated_occlusion/spheres/depth_") + format,
                    harness.scalar("ambient", small), truth.value, truth.mask,
                    {.rmse = withRays(tableError(64)), .absBias = 0.005});
    }
}

// The sky three times as bright above as at the horizon: pi times as much error as visibility has.
TEST(Chapter10Error, IrradianceOfAnOvercastSky) {
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"samples", "128"}, {"sky", "overcast"}});
    const TruthImage truth = harness.truth("irradiance", small);
    const double white = std::numbers::pi / double(exposure(harness.scene, -1));
    expectImage("10_accumulated_occlusion/spheres/irradiance", harness.picture("irradiance", small, 3),
                truth.value, truth.mask,
                {.rmse = white * withRays(tableError(128)), .absBias = white * 0.005});
}

// 64 directions above each of 35 000 vertices, 128 in all, against 256 rays (whose RMSE is 0.0065).
TEST(Chapter10Vertices, OfAKnot) {
    const Scene& scene = testScene("knot");
    ChapterHarness harness = harnessOf(scene);
    AccumulatedOcclusion occlusion;
    OcclusionOptions options;
    options.method = "vertices";
    options.samples = 128;
    occlusion.update(harness.frame("ambient", small), options, Sky::uniform(dvec3(1.0)));
    const std::vector<AmbientValue> values = occlusion.vertexValues(scene);
    const RayBundle bundle(scene);
    const std::vector<AmbientValue> exact = bakeVertices(scene, bundle, BakeSettings{}).values;
    double squares = 0.0, bias = 0.0, bent = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double error = values[i].visibility - exact[i].visibility;
        squares += error * error;
        bias += error;
        bent += glm::length(values[i].bent - exact[i].bent);
    }
    const double count = double(values.size());
    EXPECT_LE(std::sqrt(squares / count), 0.018);
    EXPECT_LE(std::abs(bias / count), 0.003);
    EXPECT_LE(bent / count, 0.02);
}

// Blended between vertices, the picture is that of the pixels, where vertices lie close enough.
TEST(Chapter10Vertices, LookLikePixels) {
    const glm::ivec2 size(96, 72);
    const Settings settings{{"samples", "64"}, {"map-size", "1024"}, {"edges", "soft"}};
    ChapterHarness pixels = harnessOf(testScene("knot"), settings);
    ChapterHarness vertices = harnessOf(testScene("knot"), settings);
    vertices.set("method", "vertices");
    const FloatImage a = pixels.scalar("ambient", size), b = vertices.scalar("ambient", size);
    const PrimaryHits hits = primaryHits(RayTracer(pixels.scene), pixels.camera, size);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        // The ground's few vertices know nothing of the knot's shadow.
        if (!hits.hits[i].valid || hits.straddling[i] || hits.hits[i].position.y < 0.01) continue;
        sum += std::abs(a.values[i] - b.values[i]);
        ++count;
    }
    ASSERT_GT(count, 500);
    EXPECT_LE(sum / count, 0.02);
}

// A scene whose values were saved is drawn by chapter 09 from the file, and other methods have none to save.
TEST(Chapter10Vertices, AreSavedAsTheyAre) {
    const TemporaryFolder folder;
    const std::string file = (folder / "baked.glb").string();
    ChapterHarness harness = harnessOf(testScene("contact"), {{"save", file}, {"samples", "8"}});
    EXPECT_THROW(harness.render("ambient", small), UsageError);
    harness.set("method", "vertices");
    for (const char* wrong : {"/tmp/never.txt", "/proc/never.glb"}) {
        harness.set("save", wrong);
        EXPECT_THROW(harness.render("ambient", small), Error) << wrong;
        EXPECT_EQ(harness.work.count("directions_added"), 0u) << "said after the work was done";
    }
    harness.set("save", file);
    harness.render("ambient", small);

    AccumulatedOcclusion occlusion;
    OcclusionOptions options;
    options.method = "vertices";
    options.samples = 8;
    occlusion.update(harness.frame("ambient", small), options, Sky::uniform(dvec3(1.0)));
    const std::vector<AmbientValue> made = occlusion.vertexValues(harness.scene);
    const auto saved = loadedAmbient(loadGltf(file));
    ASSERT_TRUE(saved.has_value());
    ASSERT_EQ(saved->size(), made.size());
    for (std::size_t i = 0; i < made.size(); ++i) ASSERT_EQ((*saved)[i].visibility, made[i].visibility) << i;
}

// --- soft edges --------------------------------------------------------------------------------------------

ImageError softErrorOf(const std::string& scene, const std::string& edges) {
    ChapterHarness harness =
        harnessOf(testScene(scene), {{"samples", "64"}, {"edges", edges}, {"map-size", "1024"}});
    return errorOf(harness.scalar("ambient", small), harness.truth("ambient", small));
}

/// Hard edges err by 0.031 there, by 64 directions.
constexpr double softBound = 0.021;

TEST(Chapter10Soft, EdgesErrLessThanHardOnesAndStayWhereTheyAre) {
    for (const char* scene : {"spheres", "gully"}) {
        const ImageError soft = softErrorOf(scene, "soft"), hard = softErrorOf(scene, "hard");
        EXPECT_LE(soft.rmse, hard.rmse) << scene;
        EXPECT_LE(soft.rmse, softBound) << scene;
        EXPECT_LE(std::abs(soft.bias), 0.003) << scene;
    }
}

TEST(Chapter10Soft, ACapIsAsLargeAsItsPartOfTheSphere) {
    for (const int count : {32, 128, 512}) {
        const double cosine = 1.0 / std::sqrt(1.0 + cellTangent(count) * cellTangent(count));
        EXPECT_NEAR(2.0 * std::numbers::pi * (1.0 - cosine), 4.0 * std::numbers::pi / count, 1e-12);
    }
    for (const int count : {1, 2, 4}) EXPECT_EQ(cellTangent(count), 0.5);
}

// --- what must be exact ------------------------------------------------------------------------------------

// An open plane sees the whole sky, with any set of directions; and its bent vector is 2/3 n.
TEST(Chapter10Exact, AnOpenPlaneIsOne) {
    const Scene scene = floorScene(false);
    for (const char* samples : {"1", "3", "33", "512"})
        for (const char* pattern : {"fibonacci", "random"}) {
            ChapterHarness harness = harnessOf(scene, {{"samples", samples}, {"directions", pattern}});
            const PrimaryHits hits = primaryHits(RayTracer(scene), harness.camera, small);
            const FloatImage seen = harness.scalar("ambient", small);
            // A single direction may lie below the horizon, and then nothing is known.
            if (harness.work["directions_added"] - harness.work["shadow_maps_skipped"] == 0) continue;
            for (std::size_t i = 0; i < seen.values.size(); ++i)
                if (hits.hits[i].valid && !hits.straddling[i]) {
                    ASSERT_NEAR(seen.values[i], 1.0f, 1e-6) << pattern << samples;
                }
        }
    ChapterHarness harness = harnessOf(scene);
    AccumulatedOcclusion occlusion;
    OcclusionOptions options;
    options.method = "vertices";
    options.samples = 512;
    occlusion.update(harness.frame("ambient", small), options, Sky::uniform(dvec3(1.0)));
    for (const AmbientValue& value : occlusion.vertexValues(scene)) {
        EXPECT_NEAR(value.visibility, 1.0, 1e-6);
        EXPECT_LE(glm::distance(value.bent, dvec3(0, 2.0 / 3.0, 0)), 2e-3);
    }
}

TEST(Chapter10Exact, AConstantSkyIsVisibility) {
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"samples", "32"}});
    const FloatImage seen = harness.scalar("ambient", small);
    const FloatImage light = harness.picture("irradiance", small, 3);
    const double white = std::numbers::pi / double(exposure(harness.scene, -1));
    for (std::size_t i = 0; i < seen.values.size(); ++i)
        ASSERT_NEAR(light.values[3 * i], white * seen.values[i], 1e-5 * white);
}

TEST(Chapter10Exact, SkippingChangesNoBit) {
    const std::pair<const char*, const char*> cases[] = {
        {"gully", "pixels"}, {"spheres", "pixels"}, {"spheres", "vertices"}};
    for (const auto& [scene, method] : cases) {
        ChapterHarness harness = harnessOf(testScene(scene), {{"samples", "100"}, {"method", method}});
        for (const char* view : {"ambient", "bent-normal", "irradiance"}) {
            harness.skip = true;
            const FloatImage skipping = harness.picture(view, small, 3);
            harness.skip = false;
            EXPECT_EQ(differing(skipping, harness.picture(view, small, 3)), 0u) << scene << view;
        }
        EXPECT_EQ(harness.work["shadow_maps_rendered"], 100);
    }
}

// Who is left out decides who shares a batch with whom. A bias derived for a batch would differ, and with it
// two pixels of this picture.
TEST(Chapter10Exact, TheBiasDoesNotDependOnTheBatch) {
    ChapterHarness harness = harnessOf(testScene("gully"), {{"samples", "128"}});
    const FloatImage usual = harness.scalar("ambient", {512, 512});
    harness.skips().switchOff(mapsBelowHorizon.name);
    harness.renderMapsAgain = true;
    EXPECT_EQ(differing(usual, harness.scalar("ambient", {512, 512})), 0u);
}

TEST(Chapter10Work, DirectionsBelowTheGroundNeedNoMap) {
    const Scene scene = floorScene(false);
    ChapterHarness harness = harnessOf(scene, {{"samples", "100"}});
    harness.picture("ambient", small, 1);
    EXPECT_EQ(harness.work["shadow_maps_rendered"], 49);  // of the lattice, with a cosine above 0.02
    EXPECT_EQ(harness.work["shadow_maps_skipped"], 51);
    // Nothing has changed, and nothing is drawn again.
    harness.picture("ambient", small, 1);
    EXPECT_EQ(harness.work["shadow_maps_rendered"], 0);
}

TEST(Chapter10Work, ReceiversThatFaceAwayAreNotLookedUp) {
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"samples", "512"}, {"map-size", "64"}});
    const auto mean = [&] {
        const FloatImage work = harness.scalar("work", small);
        double sum = 0.0;
        for (const float share : work.values) sum += share;
        return sum / double(work.values.size());
    };
    const double skipping = mean();
    harness.skip = false;
    // A batch reaches about 38 degrees from its middle: (1 - sin 38) / 2 = 0.19 of all normals face away from
    // it.
    EXPECT_LT(skipping, 0.85 * mean());
}

TEST(Chapter10Work, NeighboursOnTheSphereAreNeighboursInTheList) {
    const std::vector<dvec3> directions = compactOrder(skyDirections(512, "fibonacci", 0), 8);
    ASSERT_EQ(directions.size(), 512u);
    dvec3 sum(0.0), before(0.0);
    for (const dvec3& l : directions) sum += l;
    for (const dvec3& l : skyDirections(512, "fibonacci", 0)) before += l;
    EXPECT_LT(glm::distance(sum, before), 1e-12);  // the same ones
    for (std::size_t i = 0; i < 512; i += 32) {
        const std::span<const dvec3> batch(&directions[i], 32);
        const DirectionCone cone = coneAround(batch);
        // 32 of 512 on a cap would reach 29 degrees from its middle; square pieces reach farther.
        EXPECT_LT(cone.below, std::cos(std::acos(horizonCosine) + 0.4));
        for (const dvec3& n : skyDirections(200, "random", 5)) {
            if (glm::dot(n, cone.axis) > cone.below) continue;
            for (const dvec3& l : batch) ASSERT_LE(glm::dot(n, l), horizonCosine);
        }
    }
}

// --- frames that add up ------------------------------------------------------------------------------------

TEST(Chapter10Rotation, FramesAddUpUntilSomethingMoves) {
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"samples", "16"}, {"rotate", "true"}});
    const TruthImage truth = harness.truth("ambient", small);
    const FloatImage first = harness.scalar("ambient", small);
    FloatImage later = first;
    for (int frame = 1; frame < 12; ++frame) later = harness.scalar("ambient", small);
    // Twelve independent turns of the pattern: less than half the error, and no worse than 192 random ones.
    EXPECT_LT(rmseOf(later, truth), 0.5 * rmseOf(first, truth));
    harness.camera.position.x += 0.1;
    harness.scalar("ambient", small);
    harness.camera.position.x -= 0.1;
    EXPECT_EQ(differing(harness.scalar("ambient", small), first), 0u);
}

TEST(Chapter10Rotation, IsARotation) {
    EXPECT_EQ(skyRotation(0, 7), glm::dmat3(1.0));
    dvec3 sum(0.0);
    for (std::uint32_t i = 1; i < 2000; ++i) {
        const glm::dmat3 turn = skyRotation(i, 7);
        ASSERT_NEAR(glm::determinant(turn), 1.0, 1e-12);
        ASSERT_NEAR(glm::length(turn[0]), 1.0, 1e-12);
        sum += turn[2];
    }
    EXPECT_LT(glm::length(sum) / 2000.0, 0.05);  // 3 standard errors of a mean of unit vectors: 0.067
}

// --- relations ---------------------------------------------------------------------------------------------

// One direction is one sun. Both maps are right but for the texels that an edge crosses. (Of two directions
// the floor has one below its horizon.)
TEST(Chapter10Relations, OneDirectionIsAHardShadow) {
    Scene scene = floorScene(true);
    const dvec3 toSky = skyDirections(2, "fibonacci", 0)[0];
    ASSERT_GT(toSky.y, 0.2);
    scene.lights[0].direction = -toSky;
    const glm::ivec2 size(128, 96);
    ChapterHarness harness = harnessOf(scene, {{"samples", "2"}, {"map-size", "1024"}});
    const RayTracer tracer(scene);
    TruthImage truth = visibilityTruth(scene, tracer, harness.camera, scene.lights[0], size, true);
    const PrimaryHits hits = primaryHits(tracer, harness.camera, size);
    for (std::size_t i = 0; i < hits.hits.size(); ++i)
        if (hits.hits[i].position.y > 1e-6) truth.mask.values[i] = 0.0f;  // the box
    const FloatImage actual = harness.scalar("ambient", size);
    // Texels are 6 mm, pixels 4 cm: shadow edges of about 150 pixels, of which a texel covers a seventh.
    expectImage("10_accumulated_occlusion/one/ambient", actual, truth.value, truth.mask, {.meanAbs = 0.004});
    const FloatImage before = visibilityOfChapter03(harness, size, BiasMethod::slope);
    double different = 0.0, compared = 0.0;
    for (std::size_t i = 0; i < actual.values.size(); ++i) {
        if (truth.mask.values[i] == 0.0f) continue;
        different += actual.values[i] != before.values[i];
        ++compared;
    }
    EXPECT_LE(different / compared, 0.004);
}

TEST(Chapter10Relations, OpenGlEsDrawsTheSame) {
    const Settings settings{{"samples", "40"}};
    std::vector<FloatImage> pictures;
    for (const Api api : {Api::desktop, Api::es})
        for (const char* method : {"pixels", "vertices"}) {
            ChapterHarness harness = harnessOf(testScene("spheres"), settings, api);
            harness.set("method", method);
            pictures.push_back(harness.scalar("ambient", small));
        }
    EXPECT_EQ(differing(pictures[0], pictures[2]), 0u);
    EXPECT_EQ(differing(pictures[1], pictures[3]), 0u);
}

// --- that it can fail --------------------------------------------------------------------------------------

struct Mutation {
    const char* name;
    const char* from;
    const char* to;
};

class Chapter10Mutation : public testing::TestWithParam<Mutation> {};

// Each would be noticed by the bounds above, on the spheres or on the open plane.
TEST_P(Chapter10Mutation, IsNoticed) {
    const MutatedShaders mutated("10_accumulated_occlusion/accumulate.frag", GetParam().from, GetParam().to);
    ChapterHarness harness = harnessOf(testScene("spheres"), {{"samples", "64"}});
    const ImageError error = errorOf(harness.scalar("ambient", small), harness.truth("ambient", small));
    EXPECT_TRUE(error.rmse > withRays(tableError(64)) || std::abs(error.bias) > 0.005)
        << error.rmse << " " << error.bias;
}
INSTANTIATE_TEST_SUITE_P(
    Shader, Chapter10Mutation,
    testing::Values(Mutation{"unweighted", "if (weight <= horizonCosine) weight = 0.0;",
                             "weight = weight <= horizonCosine ? 0.0 : 1.0;"},
                    Mutation{"horizonForgotten", "if (weight <= horizonCosine) weight = 0.0;",
                             "weight = abs(weight);"},
                    Mutation{"noBias", "<= margin;", "<= -bias * facing;"},
                    Mutation{"halfATexelOff", "ivec3(at, k)", "ivec3(at + vec2(0.5, 0.0), k)"},
                    Mutation{"compareFlipped", "<= margin;", "> margin;"},
                    Mutation{"upsideDown", "dot(up, q)", "-dot(up, q)"}),
    [](const auto& mutation) { return mutation.param.name; });

class Chapter10SoftMutation : public testing::TestWithParam<Mutation> {};

TEST_P(Chapter10SoftMutation, IsNoticed) {
    const MutatedShaders mutated("10_accumulated_occlusion/soft_edges.glsl", GetParam().from, GetParam().to);
    const ImageError soft = softErrorOf("spheres", "soft");
    EXPECT_TRUE(soft.rmse > softBound || std::abs(soft.bias) > 0.003) << soft.rmse << " " << soft.bias;
}
INSTANTIATE_TEST_SUITE_P(
    Shader, Chapter10SoftMutation,
    testing::Values(Mutation{"theSurfaceIsFlat", "+ dot(tilt, offset) > margin", "> margin"},
                    Mutation{"tiltedTheOtherWay", "+ dot(tilt, offset)", "- dot(tilt, offset)"},
                    Mutation{"asWideAsCanBe", "occluders.y / occluders.x", "1.0"},
                    Mutation{"neverWide", "height >= ringHeights.x ?", "height >= 1.0 ?"},
                    Mutation{"noBias", "- uBias) * facing + dot(tilt, offset) > margin",
                             ") * facing + dot(tilt, offset) > 0.0"}),
    [](const auto& mutation) { return mutation.param.name; });

}  // namespace
}  // namespace penumbra
