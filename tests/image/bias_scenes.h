// The two scenes that a bias is judged by, and the two figures: acne on a tilted plane, leak under a wall.
#pragma once

#include <cmath>
#include <random>

#include "tests/image/chapter_harness.h"
#include "tests/image/small_scenes.h"

namespace penumbra {

inline constexpr double radiansPerDegree = 0.017453292519943295;

/// A plane that fills the camera's picture, nothing else: every fragment is lit. The light is `tilt` radians
/// off the plane's normal at the origin; `random` turns plane, light and camera.
inline Scene tiltedPlane(double tilt, LightType type, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto direction = [&] {
        const double z = 2.0 * unit(random) - 1.0, phi = 6.283185307179586 * unit(random);
        return glm::dvec3(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z);
    };
    const glm::dvec3 n = direction();
    const glm::dvec3 a = glm::normalize(glm::cross(n, direction())), b = glm::cross(n, a);
    const glm::dvec3 toLight = std::cos(tilt) * n + std::sin(tilt) * a;
    const double azimuth = 6.283185307179586 * unit(random), lean = 0.5 * unit(random);
    const glm::dvec3 toEye =
        std::cos(lean) * n + std::sin(lean) * (std::cos(azimuth) * a + std::sin(azimuth) * b);
    return SmallScene()
        .quad(-40.0 * (a + b), 80.0 * a, 80.0 * b)
        .light(type, 10.0 * toLight, -toLight, 0.5)
        .camera(4.0 * toEye, {0, 0, 0}, 0.4)
        .take();
}

/// Turns the camera of a tiltedPlane about its axis until the seam of the plane's two triangles runs into the
/// picture's corners, within a tenth of a degree: clipping leaves one triangle with a sliver along the seam,
/// which is as long as the picture and a small part of a pixel wide.
inline void turnSeamIntoCorners(Scene& scene, std::mt19937& random) {
    Camera& camera = scene.cameras[0];
    const glm::dvec3 seam = glm::dvec3(scene.positions[2]) - glm::dvec3(scene.positions[0]);
    const glm::dvec3 along = glm::normalize(seam - camera.forward * glm::dot(seam, camera.forward));
    const double angle =
        (45.0 + std::uniform_real_distribution<double>(-0.1, 0.1)(random)) * radiansPerDegree;
    camera.up = std::cos(angle) * along + std::sin(angle) * glm::cross(camera.forward, along);
}

/// Counts of one picture of a plane on which everything is lit.
struct AcneCount {
    std::size_t receivers = 0;  ///< whose angle to the light is at most 85 degrees
    std::size_t dark = 0;
    double fraction() const { return receivers ? double(dark) / double(receivers) : 0.0; }
    AcneCount& operator+=(const AcneCount& other) {
        receivers += other.receivers;
        dark += other.dark;
        return *this;
    }
};

/// `lit`: less visibility than that is dark.
inline AcneCount countAcne(ChapterHarness& harness, int size, float lit = 0.5f) {
    const FloatImage visibility = harness.scalar("visibility", glm::ivec2(size));
    const Scene& scene = harness.scene;
    const glm::dvec3 corner(scene.positions[0]);
    const glm::dvec3 n = glm::normalize(
        glm::cross(glm::dvec3(scene.positions[1]) - corner, glm::dvec3(scene.positions[2]) - corner));
    AcneCount count;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Ray ray = cameraRay(harness.camera, {x + 0.5, y + 0.5}, glm::ivec2(size));
            const double t = glm::dot(corner - ray.origin, n) / glm::dot(ray.direction, n);
            const glm::dvec3 p = ray.origin + t * ray.direction;
            if (std::abs(glm::dot(n, directionToLight(scene.lights[0], p))) <
                std::cos(85.0 * radiansPerDegree))
                continue;
            ++count.receivers;
            count.dark += visibility.at(x, y) < lit;
        }
    }
    return count;
}

/// A sheet standing on the ground without a gap, the light 45 degrees above on one side, the camera straight
/// above the strip of ground on the other side: the slides' leak.
inline Scene wallOnGround(LightType type, double metresSeen = 0.5) {
    return SmallScene()
        .quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6})
        .quad({-2.5, 0, 0}, {0, 2, 0}, {5, 0, 0})
        .light(type, {0, 4, 4}, {0, -1, -1}, 0.6)
        .flatCamera({0, 10, -0.5 * metresSeen}, {0, 0, -0.5 * metresSeen}, metresSeen)
        .take();
}

/// Mean length in metres of the lit strip at the foot of the wall, over the picture's columns.
inline double leakLength(ChapterHarness& harness, int size) {
    const FloatImage visibility = harness.scalar("visibility", glm::ivec2(size));
    const double pixel = harness.camera.height / size;
    double sum = 0.0;
    for (int x = 0; x < size; ++x) {
        int y = size - 1;  // the foot of the wall is at the bottom of the picture
        while (y >= 0 && visibility.at(x, y) > 0.5f) --y;
        sum += (size - 1 - y) * pixel;
    }
    return sum / size;
}

}  // namespace penumbra
