// Scenes of a few triangles, made in the test that needs them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra {

class SmallScene {
 public:
    SmallScene() {
        scene_.name = "small scene";
        Material white;
        white.doubleSided = true;
        scene_.materials.push_back(white);
    }

    /// Two triangles corner, corner + a, corner + a + b, corner + b; front towards cross(a, b).
    SmallScene& quad(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b) {
        return part({{corner, corner + a, corner + a + b}, {corner, corner + a + b, corner + b}}, false);
    }

    /// An axis-aligned box, closed.
    SmallScene& box(const glm::dvec3& lower, const glm::dvec3& upper) {
        std::vector<std::array<glm::dvec3, 3>> triangles;
        const glm::dvec3 size = upper - lower;
        const glm::dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
        const auto face = [&triangles](const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
            triangles.push_back({p, p + a, p + a + b});
            triangles.push_back({p, p + a + b, p + b});
        };
        face(lower, y, x), face(lower, x, z), face(lower, z, y);
        face(upper, -x, -y), face(upper, -z, -x), face(upper, -y, -z);
        return part(triangles, true);
    }

    SmallScene& part(const std::vector<std::array<glm::dvec3, 3>>& triangles, bool closed) {
        Part added;
        added.firstTriangle = std::uint32_t(scene_.triangleCount());
        added.triangleCount = std::uint32_t(triangles.size());
        added.closed = closed;
        for (const auto& triangle : triangles) {
            const glm::dvec3 n =
                glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
            for (const glm::dvec3& p : triangle) {
                scene_.indices.push_back(std::uint32_t(scene_.positions.size()));
                scene_.positions.emplace_back(p);
                scene_.normals.emplace_back(n);
                scene_.uvs.emplace_back(0.0f);
                added.bounds.extend(glm::dvec3(glm::vec3(p)));
            }
        }
        scene_.clusters.push_back(
            {added.firstTriangle, added.triangleCount, std::uint32_t(scene_.parts.size()), added.bounds});
        scene_.parts.push_back(added);
        scene_.bounds.extend(added.bounds);
        return *this;
    }

    SmallScene& light(LightType type, const glm::dvec3& position, const glm::dvec3& direction,
                      double outerCone = 0.7) {
        Light added;
        added.type = type;
        added.position = position;
        added.direction = glm::normalize(direction);
        added.outerCone = outerCone;
        scene_.lights.push_back(added);
        return *this;
    }

    SmallScene& camera(const glm::dvec3& position, const glm::dvec3& target, double verticalFov = 0.8) {
        Camera added = looking(position, target);
        added.verticalFov = verticalFov;
        scene_.cameras.push_back(added);
        return *this;
    }

    /// A camera without perspective, `height` metres high.
    SmallScene& flatCamera(const glm::dvec3& position, const glm::dvec3& target, double height) {
        Camera added = looking(position, target);
        added.orthographic = true;
        added.height = height;
        scene_.cameras.push_back(added);
        return *this;
    }

    Scene take() { return std::move(scene_); }

 private:
    static Camera looking(const glm::dvec3& position, const glm::dvec3& target) {
        Camera camera;
        camera.position = position;
        camera.forward = glm::normalize(target - position);
        const glm::dvec3 up = std::abs(camera.forward.y) > 0.99 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
        camera.up = glm::normalize(up - camera.forward * glm::dot(up, camera.forward));
        camera.near = 0.01;
        camera.far = 1000.0;
        return camera;
    }

    Scene scene_;
};

}  // namespace penumbra
