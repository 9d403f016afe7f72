// Chapter 02 against the truth. The chapter's own class is tested, so its main.cpp is part of this file.
#define main chapterMain
#include "chapters/02_shadow_test/main.cpp"
#undef main

#include <gtest/gtest.h>

#include "chapters/00_ray_traced_truth/blinn_phong.h"
#include "common/scene/light.h"
#include "tests/image/chapter_harness.h"
#include "tests/image/image_check.h"
#include "tests/image/moved_scene.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/small_scenes.h"
#include "tests/image/test_scenes.h"

namespace penumbra {
namespace {

constexpr glm::ivec2 size(192, 192);

std::unique_ptr<Chapter> chapter() {
    return std::make_unique<ShadowTest>();
}

/// Of the pixels whose exact answer is defined.
struct Shares {
    double acne = 0;  ///< lit, but shown dark, of the lit ones
    double leak = 0;  ///< dark, but shown lit, of the dark ones
    std::size_t lit = 0, dark = 0;
};

Shares shares(const FloatImage& visibility, const TruthImage& truth) {
    Shares s;
    for (std::size_t i = 0; i < visibility.values.size(); ++i) {
        if (truth.mask.values[i] == 0.0f) continue;
        const bool lit = truth.value.values[i] > 0.5f, shownLit = visibility.values[i] > 0.5f;
        (lit ? s.lit : s.dark) += 1;
        if (lit && !shownLit) s.acne += 1;
        if (!lit && shownLit) s.leak += 1;
    }
    s.acne /= double(std::max<std::size_t>(s.lit, 1));
    s.leak /= double(std::max<std::size_t>(s.dark, 1));
    return s;
}

Shares sharesOf(const std::string& scene) {
    ChapterHarness harness(chapter(), testScene(scene));
    return shares(harness.scalar("visibility", size), harness.truth("visibility", size));
}

/// Shadows are dark but for the staircase of their edges: a texel of a 1024 map is finer than these pixels.
/// Leaves and railings are nearly all edge.
double leakBound(const std::string& scene) {
    return scene == "courtyard" ? 0.04 : 0.01;
}

class AgainstTruth : public testing::TestWithParam<std::string> {};

TEST_P(AgainstTruth, ShadowsAreDarkAndLitSurfacesHaveAcne) {
    ChapterHarness harness(chapter(), testScene(GetParam()));
    harness.set("fit", "view");
    const FloatImage visibility = harness.scalar("visibility", size);
    const TruthImage truth = harness.truth("visibility", size);
    const Shares s = shares(visibility, truth);
    EXPECT_LT(s.leak, leakBound(GetParam()));
    // A random phase within the texel puts half of a slope behind the map, less where the depths are level in
    // steps.
    EXPECT_GT(s.acne, 0.15) << "the acne of the slides has gone: is there a bias in this chapter?";
    EXPECT_LT(s.acne, 0.65);
    // The same with the figures and pictures of a report: only pixels that are dark in truth.
    FloatImage darkMask = truth.mask;
    for (std::size_t i = 0; i < darkMask.values.size(); ++i)
        if (truth.value.values[i] > 0.5f) darkMask.values[i] = 0.0f;
    expectImage("02_shadow_test/" + shortName(GetParam()) + "/dark", visibility, truth.value, darkMask,
                {.meanAbs = leakBound(GetParam()), .excludedShare = 0.999});
}

TEST_P(AgainstTruth, ColourIsBlinnPhongTimesS) {
    const Scene& scene = testScene(GetParam());
    const RayTracer tracer(scene);
    const PrimaryHits seen = primaryHits(tracer, scene.cameras[0], size);
    for (int index = 0; index < int(scene.lights.size()); ++index) {
        ChapterHarness harness(chapter(), scene);
        harness.set("light", std::to_string(index));
        const FloatImage visibility = harness.scalar("visibility", size);
        const FloatImage actual = harness.picture("color", size, 3);
        const Light& light = scene.lights[std::size_t(index)];
        const glm::vec3 ambient = ambientRadiance(scene, index, ambientShare);
        const float white = 1.0f / exposure(scene, index);
        FloatImage scaled(size.x, size.y, 3), exact(size.x, size.y, 3), mask(size.x, size.y, 1);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const std::size_t i = std::size_t(y) * size.x + x;
                const Hit& hit = seen.hits[i];
                if (!hit.valid || seen.straddling[i]) continue;
                const Material& material = scene.materials[std::size_t(scene.parts[hit.part].material)];
                if (material.diffuseTexture >= 0) continue;  // texture filtering is the GPU's own
                const Surface surface = surfaceAt(scene, hit);
                const glm::dvec3 toLight = directionToLight(light, hit.position);
                const glm::dvec3 toEye = glm::normalize(scene.cameras[0].position - hit.position);
                const glm::dvec3 direct =
                    facingIrradiance(light, hit.position) * blinnPhong(surface, toLight, toEye);
                const glm::dvec3 radiance = surface.emission + glm::dvec3(ambient) * surface.diffuse +
                                            double(visibility.at(x, y)) * direct;
                mask.at(x, y) = 1.0f;
                for (int c = 0; c < 3; ++c) {
                    exact.at(x, y, c) = float(radiance[c]) / white;
                    scaled.at(x, y, c) = actual.at(x, y, c) / white;
                }
            }
        }
        // In units of white. Float against double; a highlight of exponent 1000 magnifies the rounding of a
        // normal.
        expectImage("02_shadow_test/" + shortName(GetParam()) + "/color" + std::to_string(index), scaled,
                    exact, mask, {.meanAbs = 5e-5, .excludedShare = 0.95});
    }
}

TEST_P(AgainstTruth, AttachedAndCastShadowsAreToldApart) {
    const Scene& scene = testScene(GetParam());
    const RayTracer tracer(scene);
    const PrimaryHits seen = primaryHits(tracer, scene.cameras[0], size);
    ChapterHarness harness(chapter(), scene);
    const FloatImage kind = harness.picture("shadow-kind", size, 3);
    std::size_t attached = 0, wrong = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = std::size_t(y) * size.x + x;
            if (!seen.hits[i].valid || seen.straddling[i]) continue;
            const Surface surface = surfaceAt(scene, seen.hits[i]);
            const double facing =
                glm::dot(surface.normal, directionToLight(scene.lights[0], seen.hits[i].position));
            if (std::abs(facing) < 1e-4) continue;
            const bool blue = kind.at(x, y, 2) > kind.at(x, y, 0);
            attached += facing < 0;
            wrong += blue != (facing < 0);
        }
    }
    // Slivers may turn over when the rasteriser snaps their corners: then the pixel shows the other side.
    EXPECT_LT(wrong, GetParam() == thirdPartyModel ? 100u : 10u);
    EXPECT_TRUE(attached > 0 || GetParam() == "heckbert_herf");
}
INSTANTIATE_TEST_SUITE_P(Chapter02, AgainstTruth, testing::ValuesIn(testScenes()), sceneTestName);

/// A spot light between a floor and a ceiling, shining down; the camera sees both.
Scene floorAndCeiling(LightType type) {
    return SmallScene()
        .quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})
        .box({-0.5, 0.5, -0.5}, {0.5, 0.8, 0.5})
        .quad({-4, 4, -4}, {8, 0, 0}, {0, 0, 8})
        .light(type, {0, 2, 0}, {0, -1, 0}, 0.8)
        .camera({0, 2, 9}, {0, 2, 0}, 0.9)
        .take();
}

/// Mean visibility over the pixels that see the ceiling (q <= 0), and over the floor outside the map.
struct Decisions {
    double behind = 0, outside = 0, inside = 0;
};

Decisions decisions(LightType type, const std::string& outside) {
    const Scene scene = floorAndCeiling(type);
    ChapterHarness harness(chapter(), scene);
    harness.set("outside", outside);
    const FloatImage visibility = harness.scalar("visibility", size);
    const LightFrustum frustum = fitLightFrustum(scene, scene.lights[0]);
    const RayTracer tracer(scene);
    const PrimaryHits seen = primaryHits(tracer, harness.camera, size);
    Decisions d;
    double behind = 0, out = 0, in = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = std::size_t(y) * size.x + x;
            if (!seen.hits[i].valid || seen.straddling[i]) continue;
            const glm::dvec4 strq = frustum.textureFromWorld() * glm::dvec4(seen.hits[i].position, 1.0);
            const glm::dvec2 st = glm::dvec2(strq) / strq.w;
            const bool covered = st.x > 0.01 && st.x < 0.99 && st.y > 0.01 && st.y < 0.99;
            const bool uncovered = st.x < -0.01 || st.x > 1.01 || st.y < -0.01 || st.y > 1.01;
            if (seen.hits[i].part == 2 && strq.w < -0.01) d.behind += visibility.at(x, y), ++behind;
            if (seen.hits[i].part == 0 && strq.w > 0.01 && uncovered) d.outside += visibility.at(x, y), ++out;
            if (seen.hits[i].part == 0 && strq.w > 0.01 && covered) d.inside += visibility.at(x, y), ++in;
        }
    }
    EXPECT_GT(behind, 100);
    EXPECT_TRUE(type != LightType::spot || out > 100);
    d.behind /= std::max(behind, 1.0), d.outside /= std::max(out, 1.0), d.inside /= std::max(in, 1.0);
    return d;
}

TEST(Chapter02, NoNegativeProjection) {
    // A spot light sends nothing backwards, whatever --outside says; a point light does, and its map cannot
    // know of what.
    EXPECT_EQ(decisions(LightType::spot, "lit").behind, 0.0);
    EXPECT_EQ(decisions(LightType::spot, "dark").behind, 0.0);
}

TEST(Chapter02, OutsideTheMapIsADecision) {
    EXPECT_EQ(decisions(LightType::spot, "lit").outside, 1.0);
    EXPECT_EQ(decisions(LightType::spot, "dark").outside, 0.0);
    // Inside, the flag changes nothing.
    const double inside = decisions(LightType::spot, "lit").inside;
    EXPECT_EQ(inside, decisions(LightType::spot, "dark").inside);
    EXPECT_GT(inside, 0.1);
    EXPECT_LT(inside, 0.95);
}

TEST(Chapter02, SkippingChangesNoBit) {
    for (const std::string& name : testScenes()) {
        ChapterHarness harness(chapter(), testScene(name));
        const FloatImage skipped = harness.picture("color", size, 3);
        harness.skip = false;
        expectImage("02_shadow_test/" + shortName(name) + "/skip", harness.picture("color", size, 3), skipped,
                    {}, {.maxAbs = 0.0});
    }
}

TEST(Chapter02, EsShowsTheSamePicture) {
    // Of a chapter without a bias: acne decides between equal depths, so a last bit shows. Few pixels may
    // differ.
    FloatImage pictures[2];
    for (const Api api : {Api::desktop, Api::es}) {
        ChapterHarness harness(chapter(), testScene("contact"), api);
        pictures[api == Api::es] = harness.scalar("visibility", size);
    }
    expectImage("02_shadow_test/contact/es", pictures[1], pictures[0], {}, {.meanAbs = 0.01});
}

/// Each broken shader must break the bound on shadows being dark, or that on acne being acne.
TEST(Chapter02, ABrokenShadowTestIsCaught) {
    const std::string lookup = "02_shadow_test/shadow_lookup.glsl", test = "02_shadow_test/shadowed.frag";
    struct Mutation {
        const char* what;
        std::string file, from, to;
    };
    const Mutation mutations[] = {
        {"flipped compare", test, "uFarther * zLight > uFarther * zShadow",
         "uFarther * zLight < uFarther * zShadow"},
        {"no divide by q", lookup, "float perQ = 1.0 / strq.w;", "float perQ = 1.0;"},
        {"y flipped", lookup, "ivec2(st * vec2(size))", "ivec2(vec2(st.x, 1.0 - st.y) * vec2(size))"},
        {"no depth of its own", test, "float zLight = str.z", "float zLight = 0.0"},
    };
    const auto passes = [] {
        bool all = true;
        for (const char* scene : {"contact", "heckbert_herf", "courtyard"}) {
            const Shares s = sharesOf(scene);
            all = all && s.leak < leakBound(scene) && s.acne > 0.15 && s.acne < 0.65;
        }
        return all;
    };
    EXPECT_TRUE(passes());
    for (const Mutation& m : mutations) {
        const MutatedShaders mutated(m.file, m.from, m.to);
        EXPECT_FALSE(passes()) << m.what;
    }
    const MutatedShaders mutated(lookup, "if (strq.w <= 0.0) return false;", "");
    EXPECT_NE(decisions(LightType::spot, "lit").behind, 0.0) << "negative projection";
}

}  // namespace
}  // namespace penumbra
