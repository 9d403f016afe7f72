// The camera of the window: it turns about the scene, stays upright, and comes home to the bit.
#include "common/app/orbit_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace penumbra {
namespace {

Camera start() {
    Camera camera;
    camera.position = {3.0, 2.0, 6.0};
    camera.forward = glm::normalize(glm::dvec3(-3.0, -1.5, -6.0));
    camera.up = glm::normalize(glm::cross(glm::cross(camera.forward, glm::dvec3(0, 1, 0)), camera.forward));
    return camera;
}

Aabb scene() {
    Aabb box;
    box.extend({-2.0, 0.0, -2.0});
    box.extend({2.0, 1.0, 2.0});
    return box;
}

bool same(const Camera& a, const Camera& b) {
    return a.position == b.position && a.forward == b.forward && a.up == b.up && a.height == b.height &&
           a.near == b.near && a.far == b.far;
}

TEST(OrbitCamera, StartsAndComesHomeToTheBit) {
    OrbitCamera orbit(start(), scene());
    EXPECT_TRUE(same(orbit.camera(), start()));
    orbit.orbit(0.3, 0.2);
    orbit.zoom(0.5);
    orbit.pan(0.1, 0.1);
    EXPECT_FALSE(same(orbit.camera(), start()));
    orbit.reset();
    EXPECT_TRUE(same(orbit.camera(), start()));
    OrbitCamera fresh(start(), scene());
    orbit.orbit(0.2, 0.1);
    fresh.orbit(0.2, 0.1);
    EXPECT_TRUE(same(orbit.camera(), fresh.camera())) << "about the point it started with";
}

TEST(OrbitCamera, PanningShiftsThePictureByTheHand) {
    for (const bool orthographic : {false, true}) {
        Camera before = start();
        before.orthographic = orthographic;
        before.height = 3.0;
        OrbitCamera orbit(before, scene());
        orbit.pan(0.25, 0.125);  // of the height of the window
        const Camera& after = orbit.camera();
        const double distance = glm::dot(scene().centre() - before.position, before.forward);
        const glm::dvec3 target = before.position + distance * before.forward;
        const double height = orthographic ? 3.0 : 2.0 * std::tan(0.5 * before.verticalFov) * distance;
        const glm::dvec3 right = glm::cross(after.forward, after.up);
        EXPECT_EQ(after.forward, before.forward);
        EXPECT_NEAR(glm::dot(target - after.position, right), 0.25 * height, 1e-12);
        EXPECT_NEAR(glm::dot(target - after.position, after.up), 0.125 * height, 1e-12);
        const glm::dvec3 shifted = after.position + distance * after.forward;
        orbit.orbit(0.4, 0.1);
        const glm::dvec3 still = orbit.camera().position + distance * orbit.camera().forward;
        EXPECT_NEAR(glm::distance(still, shifted), 0.0, 1e-9) << "then turns about the new middle";
    }
}

TEST(OrbitCamera, ACameraThatStartsSteeperThanTheLimitStaysSo) {
    Camera down = start();
    down.forward = {0.0, -1.0, 0.0};
    down.up = {0.0, 0.0, -1.0};
    OrbitCamera orbit(down, scene());
    orbit.orbit(0.3, 0.0);
    EXPECT_NEAR(orbit.camera().forward.y, -1.0, 1e-12);
}

TEST(OrbitCamera, ACameraThatLooksAwayFromTheSceneStillZoomsForward) {
    Camera away = start();
    away.forward = -away.forward;
    OrbitCamera orbit(away, scene());
    orbit.zoom(0.5);
    EXPECT_GT(glm::dot(orbit.camera().position - away.position, away.forward), 0.0);
}

TEST(OrbitCamera, KeepsLookingAtTheSamePointFromTheSameDistance) {
    OrbitCamera orbit(start(), scene());
    const double distance = glm::dot(scene().centre() - start().position, start().forward);
    const glm::dvec3 target = start().position + distance * start().forward;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-0.5, 0.5);
    for (int i = 0; i < 2000; ++i) {
        orbit.orbit(angle(random), angle(random));
        const Camera& camera = orbit.camera();
        ASSERT_NEAR(glm::length(camera.position + distance * camera.forward - target), 0.0, 1e-9);
        ASSERT_NEAR(glm::length(camera.forward), 1.0, 1e-12);
        ASSERT_NEAR(glm::length(camera.up), 1.0, 1e-12);
        ASSERT_NEAR(glm::dot(camera.forward, camera.up), 0.0, 1e-12);
        ASSERT_GT(camera.up.y, 0.0) << "never upside down";
        ASSERT_NEAR(glm::cross(camera.forward, camera.up).y, 0.0, 1e-6) << "the horizon stays level";
    }
}

TEST(OrbitCamera, DraggingRightTurnsTheSceneRight) {
    OrbitCamera orbit(start(), scene());
    const glm::dvec3 right = glm::cross(start().forward, start().up);
    orbit.orbit(0.1, 0.0);
    // A point in front of the target moves with the hand.
    const glm::dvec3 nearPoint = scene().centre() - start().forward;
    const auto across = [&](const Camera& camera) {
        return glm::dot(nearPoint - camera.position, glm::cross(camera.forward, camera.up));
    };
    EXPECT_GT(across(orbit.camera()), across(start()));
    EXPECT_LT(glm::dot(orbit.camera().position - start().position, right), 0.0);
    OrbitCamera raised(start(), scene());
    raised.orbit(0.0, 0.1);
    EXPECT_GT(raised.camera().position.y, start().position.y)
        << "dragging down, or the key up, looks from higher";
}

TEST(OrbitCamera, ZoomStaysOnThisSideAndKeepsTheSceneInsideTheFrustum) {
    OrbitCamera orbit(start(), scene());
    const double along = glm::dot(scene().centre() - start().position, start().forward);
    const glm::dvec3 target = start().position + along * start().forward;
    for (int i = 0; i < 300; ++i) orbit.zoom(0.9);
    EXPECT_NEAR(glm::distance(orbit.camera().position, target), 1e-3 * along, 1e-9) << "and no further";
    EXPECT_GT(glm::dot(scene().centre() - orbit.camera().position, start().forward), 0.0);
    EXPECT_LT(orbit.camera().near, 0.5 * start().near);
    for (int i = 0; i < 300; ++i) orbit.zoom(1.1);
    const double distance = glm::length(scene().centre() - orbit.camera().position);
    EXPECT_GT(orbit.camera().far, distance + scene().radius());
    EXPECT_NEAR(glm::distance(orbit.camera().position, target), 1e3 * along, 1e-6 * along)
        << "and no further";
    EXPECT_TRUE(std::isfinite(distance));
}

TEST(OrbitCamera, OrthographicZoomChangesTheHeight) {
    Camera flat = start();
    flat.orthographic = true;
    flat.height = 4.0;
    OrbitCamera orbit(flat, scene());
    orbit.zoom(0.5);
    EXPECT_EQ(orbit.camera().height, 2.0);
    EXPECT_EQ(orbit.camera().position, flat.position);
}

TEST(OrbitCamera, ACameraInsideAnEmptySceneStillTurns) {
    OrbitCamera orbit(start(), Aabb{});
    orbit.orbit(1.0, 0.3);
    orbit.zoom(2.0);
    EXPECT_TRUE(std::isfinite(orbit.camera().position.x));
    EXPECT_TRUE(std::isfinite(orbit.camera().far));
}

}  // namespace
}  // namespace penumbra
