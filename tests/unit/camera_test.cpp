// The camera's matrices and its rays are two accounts of the same projection.
#include "common/scene/camera.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {
namespace {

Camera someCamera(bool orthographic) {
    Camera camera;
    camera.position = {1.0, 2.0, 3.0};
    camera.forward = glm::normalize(glm::dvec3(0.3, -0.5, -0.8));
    camera.up =
        glm::normalize(glm::cross(glm::cross(camera.forward, glm::dvec3(0.3, 1, 0.2)), camera.forward));
    camera.orthographic = orthographic;
    camera.verticalFov = 0.9;
    camera.height = 3.0;
    camera.near = 0.5;
    camera.far = 40.0;
    return camera;
}

TEST(Camera, APointOnAPixelsRayIsProjectedToThatPixel) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const glm::ivec2 size(640, 360);
    for (const bool orthographic : {false, true}) {
        const Camera camera = someCamera(orthographic);
        const glm::dmat4 clip = clipFromWorld(camera, double(size.x) / size.y);
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec2 pixel(uniform(random) * size.x, uniform(random) * size.y);
            const Ray ray = cameraRay(camera, pixel, size);
            EXPECT_NEAR(glm::dot(ray.direction, camera.forward), 1.0, 1e-12);
            const double depth = camera.near + (camera.far - camera.near) * uniform(random);
            const glm::dvec4 c = clip * glm::dvec4(ray.origin + depth * ray.direction, 1.0);
            const glm::dvec3 ndc = glm::dvec3(c) / c.w;
            EXPECT_NEAR((ndc.x + 1.0) * 0.5 * size.x, pixel.x, 1e-9);
            EXPECT_NEAR((1.0 - ndc.y) * 0.5 * size.y, pixel.y, 1e-9) << "rows run down";
            EXPECT_LE(std::abs(ndc.z), 1.0 + 1e-12);
        }
    }
}

TEST(Camera, NearAndFarAreTheEndsOfTheDepthRange) {
    for (const bool orthographic : {false, true}) {
        const Camera camera = someCamera(orthographic);
        for (const auto& [range, atNear, atFar] :
             {std::tuple(DepthRange::standard, -1.0, 1.0), std::tuple(DepthRange::reversed, 1.0, 0.0)}) {
            const glm::dmat4 clip = clipFromView(camera, 1.5, range) * viewFromWorld(camera);
            const auto depthAt = [&](double distance) {
                const glm::dvec4 c = clip * glm::dvec4(camera.position + distance * camera.forward, 1.0);
                return c.z / c.w;
            };
            EXPECT_NEAR(depthAt(camera.near), atNear, 1e-12);
            EXPECT_NEAR(depthAt(camera.far), atFar, 1e-12);
        }
    }
}

TEST(Camera, TheViewLooksAlongMinusZWithItsUpOnY) {
    const Camera camera = someCamera(false);
    const glm::dmat4 view = viewFromWorld(camera);
    EXPECT_NEAR(glm::distance(glm::dvec3(view * glm::dvec4(camera.position, 1)), glm::dvec3(0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(glm::dvec3(view * glm::dvec4(camera.forward, 0)), glm::dvec3(0, 0, -1)), 0.0,
                1e-12);
    EXPECT_NEAR(glm::distance(glm::dvec3(view * glm::dvec4(camera.up, 0)), glm::dvec3(0, 1, 0)), 0.0, 1e-12);
}

TEST(Camera, TheCentreRayOfAnOddPictureIsTheAxis) {
    const Camera camera = someCamera(false);
    const Ray ray = cameraRay(camera, {50.5, 30.5}, {101, 61});
    EXPECT_EQ(ray.origin, camera.position);
    EXPECT_NEAR(glm::distance(ray.direction, camera.forward), 0.0, 1e-15);
}

}  // namespace
}  // namespace penumbra
