// Chapter 11: bent normals against closed forms, look-ups of a sky's irradiance against rays, and pictures
// without a NaN. The chapter's own class is tested, so its main.cpp is part of this file; so is chapter 09's,
// of whose pictures this chapter's are multiples.
#define main chapter09Main
#include "chapters/09_ambient_occlusion/main.cpp"
#undef main
#define main chapterMain
#include "chapters/11_bent_normals/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/math/sampling.h"
#include "common/truth/ambient_forms.h"
#include "tests/image/bent_scenes.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/image_check.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

using glm::dvec3;
using std::numbers::pi;

const std::string clearSky = std::string(PENUMBRA_SOURCE_DIR) + "/assets/clear_sky.hdr";
const std::string chapel = std::string(PENUMBRA_SOURCE_DIR) + "/assets/chapel.hdr";

template <class C = BentNormals>
ChapterHarness harnessOf(const Scene& scene, const Settings& settings = {}, Api api = Api::desktop) {
    ChapterHarness harness(std::make_unique<C>(), scene, api);
    harness.set(settings);
    return harness;
}

dvec3 rgb(const FloatImage& picture, std::size_t pixel) {
    return {picture.values[3 * pixel], picture.values[3 * pixel + 1], picture.values[3 * pixel + 2]};
}

double degreesBetween(const dvec3& a, const dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

bool allFinite(const FloatImage& picture) {
    return std::all_of(picture.values.begin(), picture.values.end(),
                       [](float v) { return std::isfinite(v); });
}

double largestDifference(const FloatImage& a, const FloatImage& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        largest = std::max(largest, std::abs(double(a.values[i]) - double(b.values[i])));
    return largest;
}

double brightest(const FloatImage& picture) {
    return *std::max_element(picture.values.begin(), picture.values.end());
}

// --- bent normals against closed forms ---------------------------------------------------------------------

struct FormErrors {
    double meanDegrees = 0.0;
    double meanVisibility = 0.0;
    dvec3 mean{0.0};  ///< bent normal
};

/// Pictures of bent normal and visibility against the form at each pixel.
FormErrors againstForms(const FormScene& made, const char* weighting, int samples, int side) {
    ChapterHarness harness =
        harnessOf(made.scene, {{"samples", std::to_string(samples)}, {"weighting", weighting}});
    const glm::ivec2 size(side, side);
    const FloatImage bent = harness.picture("bent-normal", size, 3), seen = harness.scalar("ambient", size);
    FormErrors errors;
    for (std::size_t i = 0; i < seen.values.size(); ++i) {
        const int x = int(i) % side, y = int(i) / side;
        const Ray ray = cameraRay(harness.camera, {x + 0.5, y + 0.5}, size);
        const FormScene::Expected expected = made.at(ray.origin.x, ray.origin.z);
        const bool uniform = std::string(weighting) == "uniform";
        const dvec3 B =
            expected.worldFromForm * (uniform ? expected.form.uniformBent : expected.form.cosineBent);
        const dvec3 shown = 2.0 * rgb(bent, i) - 1.0;
        EXPECT_NEAR(glm::length(shown), 1.0, 1e-5);
        errors.mean += shown / double(seen.values.size());
        errors.meanDegrees += degreesBetween(shown, B) / double(seen.values.size());
        errors.meanVisibility +=
            std::abs(seen.values[i] - (uniform ? expected.form.uniform : expected.form.cosine)) /
            double(seen.values.size());
    }
    return errors;
}

// The lecture's loop counts uniform rays. That leans too far towards the open side: 45 degrees.
TEST(Chapter11Forms, CornerOfTwoPlanesTellsTheWeightingsApart) {
    const FormScene corner = cornerScene();
    const FormErrors cosine = againstForms(corner, "cosine", 4096, 10);
    const FormErrors uniform = againstForms(corner, "uniform", 4096, 10);
    EXPECT_LE(cosine.meanDegrees, 0.1);
    EXPECT_LE(uniform.meanDegrees, 0.1);
    EXPECT_NEAR(degreesBetween(cosine.mean, {0, 1, 0}), glm::degrees(std::atan(2.0 / pi)), 0.02);
    EXPECT_NEAR(degreesBetween(uniform.mean, {0, 1, 0}), 45.0, 0.02);
    EXPECT_LE(cosine.meanVisibility, 0.001);
}

// Each component of a mean of 1024 directions is right to 0.002, and B is 0.35 (trench, uniform) to 0.6 long:
// 0.3 degrees across and as much along. Facets are off by up to half of 180/256 degrees.
TEST(Chapter11Forms, TrenchAndSphere) {
    for (const char* weighting : {"cosine", "uniform"}) {
        const FormErrors trench = againstForms(trenchScene(), weighting, 1024, 12);
        EXPECT_LE(trench.meanDegrees, 0.45) << weighting;
        EXPECT_LE(trench.meanVisibility, 0.003) << weighting;
        const FormErrors sphere = againstForms(sphereScene(), weighting, 1024, 12);
        EXPECT_LE(sphere.meanDegrees, 0.25) << weighting;
        EXPECT_LE(sphere.meanVisibility, 0.003) << weighting;
    }
}

TEST(Chapter11Forms, UniformRaysTakenForCosineRaysWouldBeSeen) {
    const FormScene corner = cornerScene();
    ChapterHarness harness = harnessOf(corner.scene, {{"samples", "1024"}, {"weighting", "uniform"}});
    const dvec3 shown = 2.0 * rgb(harness.picture("bent-normal", glm::ivec2(8), 3), 20) - 1.0;
    EXPECT_GT(degreesBetween(shown, corner.at(0.5, 0.0).form.cosineBent), 10.0);
}

// --- the look-ups ------------------------------------------------------------------------------------------

/// Flat facets of a ball, so that shading and geometric normals agree and every facet sees all of its sky.
ChapterHarness ballHarness(const Settings& settings, Api api = Api::desktop) {
    static const Scene scene = ballScene();
    return harnessOf(scene, settings, api);
}

// The GLSL twins of the unit-tested C++, on normals all round: A is exactly 1 there.
TEST(Chapter11LookUp, ShadersAreTheTwinsOfTheUnitTestedCode) {
    const glm::ivec2 size(96, 96);
    ChapterHarness harness = ballHarness({{"sky", chapel}, {"lookup", "normal"}, {"samples", "16"}});
    BentOptions options;
    options.sky = chapel;
    const Sky& sky = options.skyOf(harness.scene);
    const SkySamples samples = sampleSky([&](const dvec3& w) { return sky.radiance(w); });
    const ShIrradiance sh = ShIrradiance::of(samples);
    const IrradianceMap map = smallestIrradianceMap(CosineConvolution(samples));
    const RayTracer tracer(harness.scene);
    const PrimaryHits hits = primaryHits(tracer, harness.camera, size);
    for (const char* kind : {"sh", "map"}) {
        harness.set("irradiance", kind);
        const FloatImage E = harness.picture("irradiance", size, 3);
        int compared = 0;
        for (std::size_t i = 0; i < hits.hits.size(); ++i) {
            // On an edge of two facets the rasterizer may see the other one.
            if (!hits.hits[i].valid || hits.hits[i].edgeDistance < 1e-4) continue;
            const dvec3& n = hits.hits[i].shadingNormal;
            const dvec3 exact = kind[0] == 's' ? sh.at(n) : map.at(n);
            // Floats: positions on the map are right to 1e-5 of a texel.
            ASSERT_LE(glm::length(rgb(E, i) - exact), 2e-5 * glm::length(exact)) << kind;
            ++compared;
        }
        EXPECT_GT(compared, 2000);
    }
}

TEST(Chapter11LookUp, OfAUniformSkyIsExactWhateverIsLookedUpWhere) {
    const glm::ivec2 size(64, 64);
    for (const char* lookUp : {"normal", "bent"}) {
        for (const char* kind : {"sh", "map", "linear"}) {
            ChapterHarness harness =
                harnessOf(testScene("gully"),
                          {{"sky", "uniform"}, {"lookup", lookUp}, {"irradiance", kind}, {"samples", "16"}});
            const FloatImage E = harness.picture("irradiance", size, 3), A = harness.scalar("ambient", size);
            const double perA = pi / double(exposure(harness.scene, -1));
            for (std::size_t i = 0; i < A.values.size(); ++i)
                ASSERT_NEAR(E.values[3 * i], A.values[i] * perA, 4e-6 * perA) << lookUp << kind;
        }
    }
}

// "The relation between chapters": under a constant sky this is chapter 09's ambient picture times pi L.
TEST(Chapter11LookUp, UnderAConstantSkyIsChapter09TimesAConstant) {
    const glm::ivec2 size(64, 64);
    const Settings rays{{"samples", "32"}, {"sky", "uniform"}};
    ChapterHarness here = harnessOf(testScene("courtyard"), rays);
    ChapterHarness before = harnessOf<AmbientOcclusion>(testScene("courtyard"), rays);
    const FloatImage E = here.picture("irradiance", size, 3), A = before.scalar("ambient", size);
    EXPECT_EQ(here.scalar("ambient", size), A);
    const double perA = pi / double(exposure(here.scene, -1));
    for (std::size_t i = 0; i < A.values.size(); ++i)
        ASSERT_NEAR(E.values[3 * i + 1], A.values[i] * perA, 4e-6 * perA);
}

/// Largest difference, relative to the largest value, between the picture and what the very same rays bring
/// when each is asked for its radiance.
double linearError(const Settings& more = {}) {
    Settings settings{{"sky", "gradient"}, {"irradiance", "linear"}, {"samples", "64"}};
    settings.insert(settings.end(), more.begin(), more.end());
    ChapterHarness harness = harnessOf(testScene("courtyard"), settings);
    const glm::ivec2 size(64, 64);
    const FloatImage E = harness.picture("irradiance", size, 3);
    BentOptions options;
    options.sky = "gradient";
    const Sky sky = options.skyOf(harness.scene);
    const RayTracer tracer(harness.scene);
    const PrimaryHits hits = primaryHits(tracer, harness.camera, size);
    double worst = 0.0;
    for (std::size_t i = 0; i < hits.hits.size(); ++i) {
        const Hit& hit = hits.hits[i];
        if (!hit.valid || hits.straddling[i]) continue;
        std::int64_t traced = 0;
        const std::uint32_t seed = hashSeed(std::uint32_t(i) % 64u, std::uint32_t(i) / 64u, 0);
        dvec3 sum(0.0);
        for (const AmbientDirection& d :
             castAmbientRays(tracer, hit, hit.shadingNormal, options.ambient().rays(), seed, traced))
            sum += d.open * sky.radiance(d.direction);
        worst = std::max(worst, glm::length(rgb(E, i) - pi / 64.0 * sum));
    }
    return worst / brightest(E);
}

TEST(Chapter11LookUp, ThePairIsExactUnderALinearSky) {
    EXPECT_LE(linearError(), 1e-5);
}

TEST(Chapter11LookUp, ANormalisedVectorIsNot) {
    EXPECT_GT(linearError({{"irradiance", "normalised"}}), 0.05);
    const MutatedShaders mutation("11_bent_normals/irradiance.glsl", "uGradient * seen.xyz)",
                                  "uGradient * normalize(seen.xyz))");
    EXPECT_GT(linearError(), 0.05);
}

/// Root mean square error of the irradiance, relative to that of open ground.
double lookUpError(const std::string& scene, const std::string& sky, const Settings& settings) {
    Settings all{{"sky", sky}, {"samples", "256"}, {"truth-rays", "512"}};
    all.insert(all.end(), settings.begin(), settings.end());
    ChapterHarness harness = harnessOf(testScene(scene), all);
    const glm::ivec2 size(32, 32);
    const TruthImage truth = harness.truth("irradiance", size);
    BentOptions options;
    options.sky = sky;
    return compareImages(harness.picture("irradiance", size, 3), truth.value, truth.mask).rmse /
           (pi * options.skyOf(harness.scene).onOpenGround().g);
}

// Where the sky changes slowly B is nearer, by half and more. Measured on these balls: 0.06 for 0.19 of E
// = 3.
TEST(Chapter11LookUp, AlongBIsNearerThanAlongTheNormal) {
    for (const char* sky : {"gradient", "overcast"}) {
        const double alongN = lookUpError("spheres", sky, {{"lookup", "normal"}});
        const double alongB = lookUpError("spheres", sky, {{"lookup", "bent"}});
        EXPECT_LT(alongB, 0.5 * alongN) << sky;
    }
}

// No look-up knows whether a sun is behind the ball: on average a tenth to a quarter of open ground's light
// is wrong.
TEST(Chapter11LookUp, UnderASunIsNearerButNotNear) {
    const double alongN = lookUpError("spheres", clearSky, {{"lookup", "normal"}});
    const double alongB = lookUpError("spheres", clearSky, {{"lookup", "bent"}});
    EXPECT_LT(alongB, 0.85 * alongN);
    EXPECT_GT(alongB, 0.1);
}

// What is left are the rays: 256 have an error of 0.0065 where an edge covers half of the sky, the truth's
// 1024 of 0.003.
TEST(Chapter11LookUp, OnlyTheNoiseOfTheRaysIsLeftUnderTheSkiesItIsExactFor) {
    EXPECT_LE(lookUpError("gully", "gradient", {{"irradiance", "linear"}}), 0.0065);
    EXPECT_LE(lookUpError("gully", "uniform", {{"irradiance", "sh"}}), 0.0065);
}

// Indoors a sky that is seen past what is far away: the exact answer, too, ends its rays. Where a range ends
// is an edge all around, longer than that of one occluder: 15 % more than above.
TEST(Chapter11LookUp, IsAsExactWithARange) {
    EXPECT_LE(lookUpError("room", "uniform", {{"range", "1"}, {"truth-rays", "2048"}}), 1.15 * 0.0065);
    EXPECT_LE(lookUpError("room", "uniform", {{"range", "1"}, {"falloff", "smooth"}}), 0.0065);
}

// --- pictures ----------------------------------------------------------------------------------------------

const std::vector<std::string> views{"color", "irradiance", "ambient", "bent-normal", "diffuse", "work"};

class Chapter11Scenes : public testing::TestWithParam<std::string> {};

TEST_P(Chapter11Scenes, HaveNoNanAndTheSamePictureWithoutSkips) {
    const glm::ivec2 size(40, 40);
    ChapterHarness harness = harnessOf(testScene(GetParam()), {{"samples", "4"}, {"map-size", "64"}});
    for (const char* source : {"rays", "edges", "vertices", "maps"}) {
        harness.set("source", source);
        harness.skip = true;
        for (const std::string& view : views)
            EXPECT_TRUE(allFinite(harness.picture(view, size, 3))) << source << " " << view;
        const FloatImage usual = harness.picture("irradiance", size, 3);
        EXPECT_GE(*std::min_element(usual.values.begin(), usual.values.end()), 0.0f);
        if (source[0] == 'v') continue;  // a bake has tests of its own
        harness.skip = false;
        EXPECT_EQ(harness.picture("irradiance", size, 3), usual) << source;
    }
}

// As in chapter 09: 64 rays have an error of 0.018 where an edge covers half of the sky, the truth's 512 of
// 0.004, and the courtyard has twice the edges. As a colour B errs by half as much as its direction does, and
// that by A's error over its length, a half where much of the sky is seen.
TEST_P(Chapter11Scenes, AreSeenAsManyRaysSeeThem) {
    const glm::ivec2 size(32, 32);
    ChapterHarness harness = harnessOf(testScene(GetParam()), {{"samples", "64"}, {"truth-rays", "512"}});
    if (GetParam() == "room") harness.set("range", "1");
    const double error = 0.0185 * (GetParam() == "courtyard" ? std::sqrt(2.0) : 1.0);
    for (const char* view : {"ambient", "bent-normal"}) {
        const TruthImage truth = harness.truth(view, size);
        double compared = 0.0;
        for (const float defined : truth.mask.values) compared += defined;
        expectImage("11_bent_normals/" + shortName(GetParam()) + "/many_rays/" + view,
                    harness.picture(view, size, truth.value.channels), truth.value, truth.mask,
                    {.rmse = 1.15 * error, .absBias = 3.0 * error / std::sqrt(compared)});
    }
}

std::vector<std::string> bentScenes() {
    return {"spheres", "gully", "room", "courtyard", thirdPartyModel};
}
INSTANTIATE_TEST_SUITE_P(Scenes, Chapter11Scenes, testing::ValuesIn(bentScenes()), sceneTestName);

TEST(Chapter11Sources, AgreeOnBentNormals) {
    const glm::ivec2 size(40, 40);
    ChapterHarness harness = harnessOf(testScene("gully"), {{"samples", "256"}});
    const FloatImage seen = harness.scalar("ambient", size), rays = harness.picture("bent-normal", size, 3);
    const RayTracer tracer(harness.scene);
    const PrimaryHits hits = primaryHits(tracer, harness.camera, size);
    // 256 rays have about 0.5 degrees of noise; of 256 maps half lie below a point's horizon, and their
    // texels are as large as 2 cm. What lies between the vertices of a gully is not on a line: its walls are
    // a metre high.
    for (const auto& [source, degrees] : {std::pair("edges", 0.7), {"maps", 2.5}, {"vertices", 3.0}}) {
        harness.set("source", source);
        const FloatImage other = harness.picture("bent-normal", size, 3);
        EXPECT_NE(other, rays) << source;
        double sum = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < seen.values.size(); ++i) {
            if (!hits.hits[i].valid || hits.straddling[i] || seen.values[i] < 0.2f) continue;
            sum += degreesBetween(2.0 * rgb(rays, i) - 1.0, 2.0 * rgb(other, i) - 1.0);
            ++count;
        }
        EXPECT_GT(count, 500);
        EXPECT_LE(sum / count, degrees) << source;
    }
}

// In the closed class room nothing is seen: no direction, no light, and no NaN.
FloatImage darkRoom(const char* view) {
    ChapterHarness harness = harnessOf(testScene("room"), {{"samples", "16"}});
    return harness.picture(view, glm::ivec2(48), 3);
}

TEST(Chapter11Picture, WhereNothingIsSeenTheNormalStandsInAndNoLightComes) {
    const FloatImage bent = darkRoom("bent-normal"), E = darkRoom("irradiance"), A = darkRoom("ambient");
    int dark = 0;
    const RayTracer tracer(testScene("room"));
    const PrimaryHits hits = primaryHits(tracer, testScene("room").cameras.at(0), glm::ivec2(48));
    for (std::size_t i = 0; i < hits.hits.size(); ++i) {
        if (!hits.hits[i].valid || hits.straddling[i] || A.values[3 * i] > 0.0f) continue;
        ASSERT_EQ(rgb(E, i), dvec3(0.0));
        ASSERT_LE(glm::length(2.0 * rgb(bent, i) - 1.0 - hits.hits[i].shadingNormal), 1e-5);
        ++dark;
    }
    EXPECT_GT(dark, 500);
}

TEST(Chapter11Picture, ANormalisedNothingWouldBeSeen) {
    const MutatedShaders mutation("11_bent_normals/bent.frag",
                                  "return squared > 1e-12 ? bent * inversesqrt(squared) : n;",
                                  "return normalize(bent);");
    EXPECT_FALSE(allFinite(darkRoom("bent-normal")));
}

/// Largest difference between the picture and Kd E / pi on white surfaces, relative.
double reflectionError() {
    static const FormScene corner = cornerScene();
    ChapterHarness harness = harnessOf(corner.scene, {{"samples", "16"}});
    const FloatImage color = harness.picture("color", glm::ivec2(16), 3),
                     E = harness.picture("irradiance", glm::ivec2(16), 3);
    double worst = 0.0;
    for (std::size_t i = 0; i < E.values.size(); ++i)
        worst = std::max(worst, std::abs(color.values[i] / (0.8 / pi * E.values[i]) - 1.0));
    return worst;
}

TEST(Chapter11Picture, ColorIsTheDiffuseReflection) {
    EXPECT_LE(reflectionError(), 1e-6);
    const MutatedShaders forgotten("11_bent_normals/bent.frag", "Kd / pi * E ", "Kd * E ");
    EXPECT_GT(reflectionError(), 2.0);
}

// The lecture's three pictures: the third is the product of the first two.
TEST(Chapter11Picture, AdHocIsVisibilityTimesTheUnshadowedLamp) {
    const glm::ivec2 size(64, 64);
    ChapterHarness harness = harnessOf(testScene("knot"), {{"samples", "32"}, {"combine", "adhoc"}});
    const FloatImage combined = harness.picture("color", size, 3), A = harness.scalar("ambient", size),
                     diffuse = harness.picture("diffuse", size, 3);
    const RayTracer tracer(harness.scene);
    const PrimaryHits hits = primaryHits(tracer, harness.camera, size);
    for (std::size_t i = 0; i < A.values.size(); ++i) {
        if (!hits.hits[i].valid || hits.straddling[i]) continue;
        ASSERT_LE(glm::length(rgb(combined, i) - double(A.values[i]) * rgb(diffuse, i)), 1e-6);
    }
    harness.set("combine", "none");
    const FloatImage none = harness.picture("color", size, 3);
    for (std::size_t i = 0; i < A.values.size(); ++i) {
        if (!hits.hits[i].valid || hits.straddling[i]) continue;
        ASSERT_EQ(rgb(none, i), rgb(diffuse, i));
    }
}

TEST(Chapter11Picture, WithARangeTheSameIsSeenAsInChapter09) {
    const glm::ivec2 size(40, 40);
    for (const auto& [source, method] : {std::pair("rays", "rays"), {"vertices", "vertices"}})
        for (const char* falloff : {"hard", "smooth"}) {
            const Settings reach{{"samples", "16"}, {"range", "0.5"}, {"falloff", falloff}};
            ChapterHarness ours = harnessOf(testScene("room"), reach);
            ours.set("source", source);
            ChapterHarness theirs = harnessOf<AmbientOcclusion>(testScene("room"), reach);
            theirs.set("method", method);
            const FloatImage ambient = ours.scalar("ambient", size);
            EXPECT_EQ(ambient, theirs.scalar("ambient", size)) << source << falloff;
            ours.set("range", "0");
            EXPECT_GT(largestDifference(ambient, ours.scalar("ambient", size)), 0.5) << source << falloff;
        }
}

// The lamp's light has nothing to do with the sky: nothing is asked, whatever the source.
TEST(Chapter11Picture, OfTheLampAloneCostsNoRayAndNoMap) {
    const glm::ivec2 size(32, 32);
    for (const char* source : {"rays", "vertices", "maps"}) {
        ChapterHarness harness = harnessOf(testScene("knot"), {{"samples", "8"}, {"map-size", "64"}});
        harness.set("source", source);
        const FloatImage diffuse = harness.picture("diffuse", size, 3);
        harness.set("combine", "none");
        const FloatImage none = harness.picture("color", size, 3);
        EXPECT_EQ(harness.work["rays_traced"] + harness.work["shadow_maps_rendered"], 0) << source;
        harness.skip = false;
        EXPECT_EQ(harness.picture("color", size, 3), none) << source;
        EXPECT_GT(harness.work["rays_traced"] + harness.work["shadow_maps_rendered"], 0) << source;
        EXPECT_EQ(harness.picture("diffuse", size, 3), diffuse) << source;
        harness.skip = true;
        EXPECT_GT(brightest(harness.picture("irradiance", size, 3)), 0.0) << source;
    }
}

TEST(Chapter11Picture, AmbientAndBentNormalAreThoseOfManyRays) {
    const glm::ivec2 size(40, 40);
    ChapterHarness harness = harnessOf(testScene("gully"), {{"samples", "256"}, {"truth-rays", "1024"}});
    for (const char* view : {"ambient", "bent-normal"}) {
        const TruthImage truth = harness.truth(view, size);
        // 0.0065 for 256 rays where half of the sky is covered; half the length of B is 1/4 to 1/3.
        expectImage(std::string("11_bent_normals/gully/") + view,
                    harness.picture(view, size, truth.value.channels), truth.value, truth.mask,
                    {.rmse = 0.008, .absBias = 0.0008});
    }
}

// What is seen of a sky does not depend on what it looks like.
TEST(Chapter11Picture, AnotherSkyCostsNoRayAndNoShadowMap) {
    for (const auto& [source, counter] :
         {std::pair("vertices", "rays_traced"), {"maps", "shadow_maps_rendered"}}) {
        ChapterHarness harness = harnessOf(testScene("gully"), {{"samples", "16"}, {"source", source}});
        const FloatImage first = harness.picture("irradiance", glm::ivec2(48), 3);
        EXPECT_GT(harness.work.at(counter), 0);
        EXPECT_GE(harness.work.at("irradiance_map_rows"), 9);
        harness.set("sky", "gradient");
        const FloatImage other = harness.picture("irradiance", glm::ivec2(48), 3);
        EXPECT_EQ(harness.work[counter], 0) << source;
        EXPECT_GT(largestDifference(other, first), 0.1);
        harness.set("sky", "overcast");
        EXPECT_EQ(harness.picture("irradiance", glm::ivec2(48), 3), first);
    }
}

TEST(Chapter11Picture, RefusesWhatMeansNothing) {
    const auto refuses = [](const Settings& settings) {
        ChapterHarness harness = harnessOf(testScene("contact"), settings);
        harness.progress = [](double) { ADD_FAILURE() << "before a bake of minutes, not after it"; };
        EXPECT_THROW(harness.picture("color", glm::ivec2(8), 3), UsageError);
    };
    refuses({{"irradiance", "linear"}, {"weighting", "uniform"}});
    refuses({{"source", "maps"}, {"weighting", "uniform"}});
    refuses({{"source", "maps"}, {"range", "1"}});
    refuses({{"light", "60"}});
    refuses({{"sky", "nowhere/sky.hdr"}});
    refuses({{"sky", "nowhere/sky.hdr"}, {"source", "vertices"}});
    ChapterHarness harness = harnessOf(testScene("contact"));
    EXPECT_THROW(harness.truth("color", glm::ivec2(8)), UsageError);
}

// Last: the context of the tests above is replaced.
TEST(Chapter11Es, DrawsTheSamePicture) {
    const glm::ivec2 size(48, 48);
    for (const char* kind : {"sh", "map"}) {
        const Settings settings{{"irradiance", kind}, {"sky", "gradient"}, {"samples", "16"}};
        const FloatImage desktop = ballHarness(settings).picture("irradiance", size, 3);
        const FloatImage es = ballHarness(settings, Api::es).picture("irradiance", size, 3);
        EXPECT_LE(largestDifference(desktop, es), 1e-4 * brightest(desktop)) << kind;
    }
}

}  // namespace
}  // namespace penumbra
