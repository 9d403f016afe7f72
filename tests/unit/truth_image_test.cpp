// Truth pictures: golden values, what the mask leaves out, the ray-traced fallback, and the cache on disk.
#include "common/truth/truth_image.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <fstream>

#include "common/math/sampling.h"
#include "common/truth/light_visibility.h"
#include "common/truth/truth_cache.h"
#include "tests/unit/temporary_folder.h"
#include "tests/unit/test_meshes.h"

namespace penumbra {
namespace {

using namespace test_meshes;

/// A square light of side 1 at z = 2 facing down, part 0 its surface.
Light squareLight() {
    Light light;
    light.type = LightType::area;
    light.polygons = {{{-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}}};
    light.position = {0, 0, 2};
    light.direction = {0, 0, -1};
    light.area = 1.0;
    light.part = 0;
    return light;
}

/// Light, floor z = 0 and, between them, whatever the test adds.
Scene floorUnderLight() {
    Scene scene = emptyScene();
    addQuad(scene, {-0.5, -0.5, 2}, {-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2});
    addQuad(scene, {-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0});
    scene.lights = {squareLight()};
    return scene;
}

Camera fromAbove() {
    Camera camera;
    camera.position = {0, 0, 1.9};
    camera.forward = {0, 0, -1};
    camera.up = {0, 1, 0};
    camera.orthographic = true;
    camera.height = 2.0;
    return camera;
}

class TruthImages : public testing::Test {
 protected:
    void SetUp() override { ::setenv("PENUMBRA_TRUTH_CACHE", folder_.path().c_str(), 1); }
    void TearDown() override { ::unsetenv("PENUMBRA_TRUTH_CACHE"); }
    std::size_t filesInCache() const { return folder_.entries(); }
    const TemporaryFolder folder_;
};

TEST_F(TruthImages, GivesTheGoldenValuesOfTheAreaLight) {
    Scene scene = floorUnderLight();
    addPart(scene, {{-0.4, -0.35, 1}, {0.45, -0.3, 1}, {0, 0.45, 1}}, {0, 1, 2}, scaledAndMoved(1, 0));
    const RayTracer tracer(scene);
    const ExactScene exact(scene);
    const LightVisibility visibility(exact, tracer, scene.lights[0], false);
    // Evaluated once in 113-bit arithmetic by cone subtraction; the mesh here is rounded to float: 1e-6.
    const std::vector<std::pair<glm::dvec2, double>> golden = {{{0, 0}, 0.137946992643},
                                                               {{0.5, 0}, 0.507415225179},
                                                               {{-0.3, 0.4}, 0.627176179556},
                                                               {{0.9, 0.9}, 1.0},
                                                               {{0, -0.8}, 0.721839040390}};
    for (const auto& [x, value] : golden) {
        const Hit hit = tracer.nearest({{x.x, x.y, 0.5}, {0, 0, -1}});
        ASSERT_TRUE(hit.valid);
        const LightAnswer answer = visibility.at(hit, 0);
        EXPECT_TRUE(answer.facing);
        EXPECT_FALSE(answer.rayTraced);
        EXPECT_NEAR(answer.visible, value, 1e-6);
    }
}

TEST_F(TruthImages, ThePointAtTheCentreMakesAHardShadow) {
    Scene scene = floorUnderLight();
    addQuad(scene, {-0.25, -0.25, 1}, {0.25, -0.25, 1}, {0.25, 0.25, 1}, {-0.25, 0.25, 1});
    const RayTracer tracer(scene);
    Camera camera = fromAbove();
    camera.position.z = 0.9;
    // The shadow of a square of half side 1/4 half way up is a square of half side 1/2.
    const TruthImage truth = visibilityTruth(scene, tracer, camera, scene.lights[0], {64, 64}, true);
    EXPECT_EQ(truth.method, "closed form");
    EXPECT_EQ(truth.against, "point light");
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const glm::dvec2 p = 2.0 * (glm::dvec2(x + 0.5, y + 0.5) / 64.0 - 0.5);
            EXPECT_EQ(truth.mask.at(x, y), 1.0f);
            EXPECT_EQ(truth.value.at(x, y), std::max(std::abs(p.x), std::abs(p.y)) < 0.5 ? 0.0f : 1.0f);
        }
    }
}

TEST_F(TruthImages, LeavesOutBackgroundFacingAwayAndSilhouettes) {
    Scene scene = emptyScene();
    addBox(scene, scaledAndMoved(1.0, 0.0));
    Light light;
    light.direction = {0, 0, 1};  // shines on the side that the camera does not see
    Camera camera = fromAbove();
    camera.position.z = 3.0;
    const RayTracer tracer(scene);
    const TruthImage truth = visibilityTruth(scene, tracer, camera, light, {31, 31}, true);
    // Half the width: 15.5 pixels across. The box covers the centres of 15 x 15; the outer ring of them
    // straddles.
    EXPECT_EQ(truth.background, std::size_t(31 * 31 - 15 * 15));
    EXPECT_EQ(truth.straddling, 0u);
    EXPECT_EQ(truth.facingAway, std::size_t(15 * 15));
    light.direction = {0, 0, -1};
    camera.position +=
        glm::dvec3(1.0 / 31.0, 0.0, 0.0);  // half a pixel: edges now cut pixels whose centre sees the box
    const TruthImage moved = visibilityTruth(scene, tracer, camera, light, {31, 31}, true);
    EXPECT_EQ(moved.facingAway, 0u);
    EXPECT_GT(moved.straddling, 0u);
    double counted = 0.0;
    for (const float m : moved.mask.values) counted += double(m);
    EXPECT_EQ(moved.background + moved.straddling + std::size_t(counted), std::size_t(31 * 31));
}

TEST_F(TruthImages, RaysStandInBehindManyLeaves) {
    Scene scene = floorUnderLight();
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t leaf = 0; leaf < 900; ++leaf) {
        const glm::dvec2 u = owenSobol(leaf, 9) - 0.5;
        const auto base = std::uint32_t(points.size());
        for (const glm::dvec3& p :
             {glm::dvec3(0, 0, 0), glm::dvec3(0.03, 0, 0.02), glm::dvec3(0, 0.03, 0.01)})
            points.push_back(glm::dvec3(0.5 * u, 1.0) + p);
        for (std::uint32_t k = 0; k < 3; ++k) indices.push_back(base + k);
    }
    addPart(scene, points, indices, scaledAndMoved(1, 0));
    const RayTracer tracer(scene);
    const ExactScene exact(scene);
    const Light& light = scene.lights[0];
    const LightVisibility visibility(exact, tracer, light, false);
    double sum2 = 0.0, random2 = 0.0;
    for (std::uint32_t k = 0; k < 20; ++k) {
        const glm::dvec2 u = 0.5 * (owenSobol(k, 3) - 0.5);
        const Hit hit = tracer.nearest({{u.x, u.y, 0.5}, {0, 0, -1}});
        const LightAnswer answer = visibility.at(hit, k);
        ASSERT_TRUE(answer.rayTraced);
        const double whole =
            exact.visibleFormFactor(hit.position, hit.shadingNormal, light.polygons[0], 2, hit.triangle);
        const double seen =
            exact.visibleFormFactor(hit.position, hit.shadingNormal, light.polygons[0], 0, hit.triangle);
        EXPECT_GT(seen, 0.0);
        EXPECT_LT(seen, 0.95 * whole);
        const double share = seen / whole;
        sum2 += std::pow(answer.visible - share, 2.0);
        random2 += share * (1.0 - share) / 4096.0;
    }
    // However many edges there are, 4096 spread points are no worse than random ones, whose rms is 0.0070
    // behind these leaves (0.0029 found).
    EXPECT_LE(std::sqrt(sum2 / 20.0), std::sqrt(random2 / 20.0));
}

TEST_F(TruthImages, IrradianceAddsUpAndFollowsThePointLightLaw) {
    Scene scene = emptyScene();
    addQuad(scene, {-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0});
    Light lamp;
    lamp.type = LightType::point;
    lamp.position = {0, 0, 2};
    lamp.emission = {3, 2, 1};
    const std::vector<Light> two = {lamp, lamp};
    const RayTracer tracer(scene);
    const TruthImage truth = irradianceTruth(scene, tracer, fromAbove(), two, {33, 33}, false);
    const glm::dvec2 p = 2.0 * (glm::dvec2(4.5, 16.5) / 33.0 - 0.5);
    const double r2 = glm::dot(p, p) + 4.0;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(truth.value.at(4, 16, c), 2.0 * lamp.emission[c] * 2.0 / std::pow(r2, 1.5), 1e-6);
    EXPECT_EQ(truth.against, "all lights");
}

TEST_F(TruthImages, AreFoundAgainAndADamagedFileIsComputedAgain) {
    Scene scene = floorUnderLight();
    const RayTracer tracer(scene);
    const auto compute = [&] {
        return visibilityTruth(scene, tracer, fromAbove(), scene.lights[0], {16, 16}, false);
    };
    const TruthImage first = compute();
    ASSERT_EQ(filesInCache(), 1u);
    const std::filesystem::path file = *std::filesystem::directory_iterator(folder_.path());
    const std::string stored = bytesOf(file);
    EXPECT_EQ(compute().value, first.value);
    const Light& light = scene.lights[0];
    EXPECT_EQ(visibilityTruth(scene, tracer, fromAbove(), light, {16, 16}, true).against, "point light");
    EXPECT_EQ(visibilityTruth(scene, tracer, fromAbove(), light, {16, 8}, false).value.height, 8);
    EXPECT_EQ(
        irradianceTruth(scene, tracer, fromAbove(), std::span(&light, 1), {16, 16}, false).value.channels, 3);
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        if (entry.path() != file) std::filesystem::remove(entry.path());

    // One flipped bit in the middle, and a file cut short: found out, computed, written again.
    std::string flipped = stored;
    flipped[flipped.size() / 2] ^= 4;
    for (const std::string& damaged : {flipped, stored.substr(0, stored.size() / 2), std::string()}) {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << damaged;
        const TruthImage again = compute();
        EXPECT_EQ(again.value, first.value);
        EXPECT_EQ(again.mask, first.mask);
        EXPECT_EQ(again.method, first.method);
        EXPECT_EQ(bytesOf(file), stored);
    }

    scene.positions[0].x += 0.001f;
    compute();
    EXPECT_EQ(filesInCache(), 2u);
}

TEST_F(TruthImages, AreTheSameForAnyNumberOfThreads) {
    Scene scene = floorUnderLight();
    addQuad(scene, {-0.25, -0.25, 1}, {0.25, -0.25, 1}, {0.25, 0.25, 1}, {-0.25, 0.25, 1});
    const RayTracer tracer(scene);
    ::setenv("PENUMBRA_TRUTH_CACHE", (folder_ / "many").c_str(), 1);
    const TruthImage many = visibilityTruth(scene, tracer, fromAbove(), scene.lights[0], {32, 32}, false);
    ::setenv("PENUMBRA_TRUTH_CACHE", (folder_ / "one").c_str(), 1);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const TruthImage single = visibilityTruth(scene, tracer, fromAbove(), scene.lights[0], {32, 32}, false);
    EXPECT_EQ(many.value, single.value);
}

TEST(ParallelRows, VisitsEachRowOnceReportsProgressAndPassesErrorsOn) {
    std::vector<int> visits(100, 0);
    double last = 0.0;
    parallelRows(
        100, [&](int row) { ++visits[std::size_t(row)]; }, [&](double f) { last = std::max(last, f); });
    EXPECT_EQ(visits, std::vector<int>(100, 1));
    EXPECT_EQ(last, 1.0);
    EXPECT_THROW(parallelRows(4, [](int) { throw std::runtime_error("row"); }), std::runtime_error);
}

}  // namespace
}  // namespace penumbra
