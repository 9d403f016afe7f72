// Small scenes under polygonal lights, and whole scenes turned by any angle.
#pragma once

#include <numeric>

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

}  // namespace penumbra
