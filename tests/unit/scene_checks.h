// What holds for every scene, whatever file it came from.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/scene/clusters.h"
#include "common/scene/scene.h"

namespace penumbra {

inline bool contains(const Aabb& box, const glm::dvec3& p) {
    return glm::all(glm::lessThanEqual(box.lower, p)) && glm::all(glm::lessThanEqual(p, box.upper));
}

inline bool hasNote(const Scene& scene, const std::string& text) {
    return std::any_of(scene.notes.begin(), scene.notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

inline void checkVertices(const Scene& scene) {
    ASSERT_EQ(scene.normals.size(), scene.positions.size());
    ASSERT_EQ(scene.uvs.size(), scene.positions.size());
    ASSERT_EQ(scene.indices.size() % 3, 0u);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        ASSERT_TRUE(std::isfinite(glm::length(glm::dvec3(scene.positions[i])))) << "position " << i;
        ASSERT_NEAR(glm::length(scene.normals[i]), 1.0f, 1e-6f) << "normal " << i;
        ASSERT_TRUE(contains(scene.bounds, scene.positions[i])) << "position " << i;
    }
    std::vector<bool> used(scene.positions.size(), false);
    for (const std::uint32_t index : scene.indices) {
        ASSERT_LT(index, scene.positions.size());
        used[index] = true;
    }
    EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; })) << "a vertex is not used";
}

inline void checkParts(const Scene& scene) {
    std::uint32_t next = 0;
    for (const Part& part : scene.parts) {
        ASSERT_EQ(part.firstTriangle, next);
        ASSERT_GT(part.triangleCount, 0u);
        ASSERT_LT(std::size_t(part.material), scene.materials.size());
        next += part.triangleCount;
    }
    ASSERT_EQ(next, scene.triangleCount());
    next = 0;
    for (const Cluster& cluster : scene.clusters) {
        ASSERT_EQ(cluster.firstTriangle, next);
        ASSERT_GT(cluster.triangleCount, 0u);
        ASSERT_LE(cluster.triangleCount, maxClusterTriangles);
        const Part& part = scene.parts.at(cluster.part);
        ASSERT_GE(cluster.firstTriangle, part.firstTriangle);
        next += cluster.triangleCount;
        ASSERT_LE(next, part.firstTriangle + part.triangleCount);
        for (std::uint32_t i = 3 * cluster.firstTriangle; i < 3 * next; ++i) {
            const glm::dvec3 p = scene.positions[scene.indices[i]];
            ASSERT_TRUE(contains(cluster.bounds, p) && contains(part.bounds, p));
        }
    }
    ASSERT_EQ(next, scene.triangleCount());
}

inline void checkViews(const Scene& scene) {
    ASSERT_FALSE(scene.cameras.empty());
    ASSERT_FALSE(scene.lights.empty());
    ASSERT_FALSE(scene.materials.empty());
    for (const Camera& camera : scene.cameras) {
        EXPECT_NEAR(glm::length(camera.forward), 1.0, 1e-12);
        EXPECT_NEAR(glm::length(camera.up), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0.0, 1e-12);
        EXPECT_LT(camera.near, camera.far);
        EXPECT_TRUE(std::isfinite(camera.far));
    }
    for (const Light& light : scene.lights) {
        EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
        if (light.type == LightType::area) {
            EXPECT_GT(light.area, 0.0);
        }
    }
    for (const Material& material : scene.materials) {
        if (material.diffuseTexture >= 0) {
            EXPECT_LT(std::size_t(material.diffuseTexture), scene.textures.size());
        }
    }
}

inline void checkScene(const Scene& scene) {
    ASSERT_GT(scene.triangleCount(), 0u);
    checkVertices(scene);
    checkParts(scene);
    checkViews(scene);
}

}  // namespace penumbra
