#include "tests/stress/triangle_soup.h"

#include "common/truth/surface_hit.h"

namespace penumbra::stress {

Scene sceneOf(const std::vector<Triangle>& triangles) {
    Scene scene;
    scene.materials.emplace_back();
    scene.lights.emplace_back();
    scene.cameras.emplace_back();
    for (const Triangle& t : triangles) {
        std::array<glm::dvec3, 3> rounded;
        for (std::size_t i = 0; i < 3; ++i) {
            scene.indices.push_back(std::uint32_t(scene.positions.size()));
            scene.positions.emplace_back(t[i]);
            rounded[i] = glm::dvec3(scene.positions.back());
            scene.bounds.extend(rounded[i]);
        }
        const glm::dvec3 normal = glm::cross(rounded[1] - rounded[0], rounded[2] - rounded[0]);
        const double length = glm::length(normal);
        scene.normals.insert(scene.normals.end(), 3,
                             length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f, 1.0f, 0.0f));
    }
    scene.uvs.resize(scene.positions.size(), glm::vec2(0.0f));
    Part part;
    part.triangleCount = std::uint32_t(triangles.size());
    part.bounds = scene.bounds;
    scene.parts.push_back(part);
    return scene;
}

std::vector<Triangle> trianglesIn(const Scene& scene) {
    std::vector<Triangle> triangles;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) triangles.push_back(cornersOf(scene, t));
    return triangles;
}

}  // namespace penumbra::stress
