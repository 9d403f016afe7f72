// Small scenes under polygonal lights, and whole scenes turned by any angle.
#pragma once

#include <numeric>
#include <string>

#include "common/math/polygon.h"
#include "common/math/sampling.h"
#include "tests/image/small_scenes.h"

namespace penumbra {

/// Adds a light with the given front (counter-clockwise corners) and radiance 8; it has no surface.
inline Scene withAreaLight(Scene scene, const std::vector<glm::dvec3>& corners) {
    Light light;
    light.type = LightType::area;
    light.polygons = {corners};
    light.direction = glm::normalize(areaNormal(corners));
    light.area = polygonArea(corners);
    light.position =
        std::accumulate(corners.begin(), corners.end(), glm::dvec3(0.0)) / double(corners.size());
    light.emission = glm::dvec3(8.0);
    scene.lights.push_back(light);
    return scene;
}

/// Corners of a square of `side` metres at `centre` that shines along `direction`.
inline std::vector<glm::dvec3> squareLight(const glm::dvec3& centre, const glm::dvec3& direction,
                                           double side) {
    const glm::dvec3 n = glm::normalize(direction);
    const glm::dvec3 axis = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 u = 0.5 * side * glm::normalize(glm::cross(axis, n)),
                     v = 0.5 * side * glm::normalize(glm::cross(n, u));
    return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

/// The same scene turned about `axis`: nothing about its light changes but the rounding.
inline Scene turned(Scene scene, const glm::dvec3& axis, double angle) {
    const glm::dvec3 k = glm::normalize(axis);
    const auto turn = [&](const glm::dvec3& v) {  // Rodrigues
        return v * std::cos(angle) + glm::cross(k, v) * std::sin(angle) +
               k * glm::dot(k, v) * (1.0 - std::cos(angle));
    };
    for (glm::vec3& p : scene.positions) p = glm::vec3(turn(glm::dvec3(p)));
    for (glm::vec3& n : scene.normals) n = glm::vec3(turn(glm::dvec3(n)));
    scene.bounds = {};
    for (const glm::vec3& p : scene.positions) scene.bounds.extend(glm::dvec3(p));
    const auto boundsOf = [&](std::uint32_t first, std::uint32_t count) {
        Aabb box;
        for (std::size_t i = 3 * std::size_t(first); i < 3 * std::size_t(first + count); ++i)
            box.extend(glm::dvec3(scene.positions[scene.indices[i]]));
        return box;
    };
    for (Part& part : scene.parts) part.bounds = boundsOf(part.firstTriangle, part.triangleCount);
    for (Cluster& cluster : scene.clusters)
        cluster.bounds = boundsOf(cluster.firstTriangle, cluster.triangleCount);
    for (Light& light : scene.lights) {
        light.position = turn(light.position);
        light.direction = turn(light.direction);
        for (auto& polygon : light.polygons)
            for (glm::dvec3& p : polygon) p = turn(p);
    }
    for (Camera& camera : scene.cameras) {
        camera.position = turn(camera.position);
        camera.forward = turn(camera.forward);
        camera.up = turn(camera.up);
    }
    return scene;
}

/// A floor of 2 x 2 metres, seen from straight above (what stands on it does not hide it: the camera is
/// below).
inline SmallScene floorScene() {
    SmallScene scene;
    scene.quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}).flatCamera({0, 0.012, 0}, {0, 0, 0}, 2.0);
    return scene;
}

/// A floor, a lamp above, and a sheet so large that some of the floor sees nothing of the lamp.
inline Scene umbraScene() {
    return withAreaLight(floorScene().quad({-0.6, 0.5, 0.4}, {1, 0, 0}, {0, 0, -0.9}).take(),
                         squareLight({0, 1.5, 0}, {0, -1, 0}, 0.6));
}

/// What a projection of occluders could get wrong.
struct HardCase {
    std::string name;
    Scene scene;
};

inline std::vector<HardCase> hardCases() {
    const auto above = squareLight({0, 1.5, 0}, {0, -1, 0}, 0.8);
    std::vector<HardCase> all;
    const auto add = [&](const char* name, SmallScene scene, const std::vector<glm::dvec3>& light) {
        all.push_back({name, withAreaLight(scene.take(), light)});
    };
    add("light partly below the horizon", floorScene().quad({-0.3, 0, -0.2}, {0.6, 0, 0}, {0, 0.3, 0}),
        squareLight({0, 0.1, -1.4}, {0, 0.2, 1}, 0.8));
    add("light point in the plane of the receiver",
        floorScene().quad({-0.3, 0, -0.2}, {0.6, 0, 0}, {0, 0.3, 0}),
        squareLight({0, 0, -1.4}, {0, 0, 1}, 0.8));
    add("occluder crosses the receiver", floorScene().quad({-0.4, -0.3, 0.1}, {0.8, 0, 0}, {0.1, 0.7, -0.2}),
        above);
    add("occluder touches the receiver", floorScene().quad({-0.4, 0, 0.1}, {0.8, 0, 0}, {0, 0.4, 0.2}),
        above);
    add("occluder passes through the light's plane",
        floorScene().quad({0.1, 0.4, -0.5}, {0, 0, 1}, {0.9, 1.9, 0}),
        squareLight({-0.2, 1.2, 0}, {0, -1, 0}, 0.5));
    add("degenerate triangles",
        floorScene()
            .part({{glm::dvec3(-0.4, 0.5, -0.4), glm::dvec3(-0.4, 0.5, -0.4), glm::dvec3(0.4, 0.5, 0.4)},
                   {glm::dvec3(-0.4, 0.5, 0), glm::dvec3(0, 0.5, 0), glm::dvec3(0.4, 0.5, 0)}},
                  false)
            .quad({-0.2, 0.6, 0.2}, {0.4, 0, 0}, {0, 0, -0.4}),
        above);
    add("overlapping occluders",
        floorScene()
            .quad({-0.4, 0.5, 0.3}, {0.7, 0, 0}, {0, 0, -0.6})
            .quad({-0.1, 0.8, 0.1}, {0.5, 0.1, 0}, {0, 0, -0.5})
            .box({-0.5, 0, -0.5}, {-0.2, 0.3, -0.1}),
        above);
    add("light that shines away", floorScene().quad({-0.2, 0.6, 0.2}, {0.4, 0, 0}, {0, 0, -0.4}),
        squareLight({0, 1.5, 0}, {0, 1, 0}, 0.8));
    return all;
}

/// A large tilted light close to the floor, so that no weight is like another; an occluder close to the
/// light.
inline Scene mutationScene() {
    return withAreaLight(floorScene()
                             .quad({-0.5, 0.2, 0.3}, {0.8, 0, 0}, {0, 0, -0.7})
                             .quad({0.35, 0.62, -0.3}, {0.25, 0.05, 0}, {0, 0, 0.5})
                             .take(),
                         squareLight({0.5, 0.75, 0.0}, {-0.55, -1, 0}, 1.1));
}

}  // namespace penumbra
