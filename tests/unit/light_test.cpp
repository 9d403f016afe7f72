// What lights send out when nothing is in between.
#include "common/scene/light.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

Light lightOf(LightType type) {
    Light light;
    light.type = type;
    light.position = {0, 4, 0};
    light.direction = {0, -1, 0};
    light.emission = {8, 4, 2};
    light.innerCone = 0.2;
    light.outerCone = 0.6;
    light.area = 0.5;
    return light;
}

TEST(Light, PointLightFallsOffWithTheSquare) {
    const Light light = lightOf(LightType::point);
    EXPECT_EQ(facingIrradiance(light, {0, 0, 0}), glm::dvec3(0.5, 0.25, 0.125));
    EXPECT_EQ(facingIrradiance(light, {0, 12, 0}), glm::dvec3(0.125, 0.0625, 0.03125)) << "any direction";
    EXPECT_EQ(directionToLight(light, {0, 12, 0}), glm::dvec3(0, -1, 0));
    EXPECT_EQ(facingIrradiance(light, light.position), glm::dvec3(0.0)) << "no division by zero";
}

TEST(Light, DirectionalLightIsTheSameEverywhere) {
    const Light light = lightOf(LightType::directional);
    EXPECT_EQ(facingIrradiance(light, {9, -7, 3}), light.emission);
    EXPECT_EQ(directionToLight(light, {9, -7, 3}), glm::dvec3(0, 1, 0));
}

TEST(Light, SpotConeIsASquaredRampOfTheCosine) {
    const Light light = lightOf(LightType::spot);
    const auto factorAt = [&](double angle) {
        return spotFactor(light, -glm::dvec3(std::sin(angle), -std::cos(angle), 0));
    };
    EXPECT_EQ(factorAt(0.0), 1.0);
    EXPECT_EQ(factorAt(0.199), 1.0);
    EXPECT_EQ(factorAt(0.601), 0.0);
    EXPECT_EQ(factorAt(3.0), 0.0);
    const double halfway = std::acos(0.5 * (std::cos(0.2) + std::cos(0.6)));
    EXPECT_NEAR(factorAt(halfway), 0.25, 1e-12);
    EXPECT_NEAR(facingIrradiance(light, {0, 2, 0}).r, 2.0, 1e-12);
    EXPECT_EQ(facingIrradiance(light, {4, 0, 0}).r, 0.0) << "45 degrees off the axis";
    EXPECT_EQ(spotFactor(lightOf(LightType::point), {0, -1, 0}), 1.0);
}

TEST(Light, ASpotWithOneConeIsAHardEdge) {
    Light light = lightOf(LightType::spot);
    light.innerCone = light.outerCone;
    EXPECT_EQ(spotFactor(light, -glm::dvec3(std::sin(0.59), -std::cos(0.59), 0)), 1.0);
    EXPECT_EQ(spotFactor(light, -glm::dvec3(std::sin(0.61), -std::cos(0.61), 0)), 0.0);
    EXPECT_EQ(spotFactor(light, -glm::dvec3(std::sin(0.6), -std::cos(0.6), 0)), 1.0)
        << "on the edge, not 0 / 0";
}

TEST(Light, AreaLightFarAwayIsAPointOfTheSameIntensity) {
    const Light light = lightOf(LightType::area);
    EXPECT_NEAR(facingIrradiance(light, {0, 2, 0}).r, 8.0 * 0.5 / 4.0, 1e-12);
    const glm::dvec3 slanted(2, 2, 0);  // 45 degrees off the axis, distance^2 = 8
    EXPECT_NEAR(facingIrradiance(light, slanted).r, 8.0 * 0.5 * std::sqrt(0.5) / 8.0, 1e-12);
    EXPECT_EQ(facingIrradiance(light, {0, 6, 0}), glm::dvec3(0.0)) << "behind it";
}

Scene sceneWith(std::vector<Light> lights) {
    Scene scene;
    scene.lights = std::move(lights);
    scene.bounds.extend(glm::dvec3(-1, 0, -1));
    scene.bounds.extend(glm::dvec3(1, 0, 1));
    return scene;
}

TEST(Light, ExposureTurnsKeyLightOnWhiteIntoWhite) {
    const Scene scene = sceneWith({lightOf(LightType::directional)});
    const double irradiance = (8.0 + 4.0 + 2.0) / 3.0;
    EXPECT_NEAR(keyIrradiance(scene, 0), irradiance, 1e-12);
    EXPECT_NEAR(exposure(scene, 0) * irradiance / 3.14159265358979, 1.0, 1e-6);
    EXPECT_NEAR(ambientRadiance(scene, 0, 0.1).r * exposure(scene, 0), 0.1, 1e-6);
}

TEST(Light, KeyIrradianceOfAllLightsIsTheSumAndNeverZero) {
    const Scene scene = sceneWith({lightOf(LightType::point), lightOf(LightType::area)});
    EXPECT_NEAR(keyIrradiance(scene, -1), keyIrradiance(scene, 0) + keyIrradiance(scene, 1), 1e-12);
    EXPECT_NEAR(keyIrradiance(scene, 0), 14.0 / 3.0 / 16.0, 1e-12);
    EXPECT_NEAR(keyIrradiance(scene, 1), 14.0 / 3.0 * 0.5 / 16.0, 1e-12);
    EXPECT_EQ(keyIrradiance(sceneWith({}), -1), 1.0);
}

TEST(Light, ALampInTheMiddleOfTheSceneIsNotInfinitelyBright) {
    Light lamp = lightOf(LightType::point);
    lamp.position = {0, 0, 0};
    const double radius = std::sqrt(2.0);
    EXPECT_NEAR(keyIrradiance(sceneWith({lamp}), 0), 14.0 / 3.0 / (0.25 * radius * 0.25 * radius), 1e-9);
}

}  // namespace
}  // namespace penumbra
