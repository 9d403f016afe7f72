// Small meshes for the tests: a Scene from triangles, moved and scaled in double before rounding to float.
#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra::test_meshes {

using Place = std::function<glm::dvec3(const glm::dvec3&)>;

inline Place scaledAndMoved(double scale, double offset) {
    return [=](const glm::dvec3& p) { return scale * p + glm::dvec3(offset); };
}

inline Scene emptyScene() {
    Scene scene;
    scene.name = "test";
    scene.materials.emplace_back();
    scene.lights.emplace_back();
    scene.cameras.emplace_back();
    return scene;
}

/// Adds an indexed mesh as one part; the shading normal of a vertex is the mean of its faces'.
inline void addPart(Scene& scene, const std::vector<glm::dvec3>& points,
                    const std::vector<std::uint32_t>& indices, const Place& place) {
    Part part;
    part.firstTriangle = std::uint32_t(scene.triangleCount());
    part.triangleCount = std::uint32_t(indices.size() / 3);
    const auto base = std::uint32_t(scene.positions.size());
    std::vector<glm::dvec3> placed;
    for (const glm::dvec3& p : points) {
        placed.push_back(place(p));
        const glm::vec3 rounded(placed.back());
        scene.positions.push_back(rounded);
        scene.bounds.extend(glm::dvec3(rounded));
        part.bounds.extend(glm::dvec3(rounded));
    }
    std::vector<glm::vec3> normals(points.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::dvec3 &a = placed[indices[i]], &b = placed[indices[i + 1]], &c = placed[indices[i + 2]];
        for (int k = 0; k < 3; ++k)
            normals[indices[i + std::size_t(k)]] += glm::vec3(glm::normalize(glm::cross(b - a, c - a)));
    }
    for (glm::vec3& n : normals) n = glm::normalize(n);
    scene.normals.insert(scene.normals.end(), normals.begin(), normals.end());
    scene.uvs.resize(scene.positions.size(), glm::vec2(0.0f));
    for (const std::uint32_t i : indices) scene.indices.push_back(base + i);
    scene.parts.push_back(part);
}

inline void addQuad(Scene& scene, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& d, const Place& place = scaledAndMoved(1.0, 0.0)) {
    addPart(scene, {a, b, c, d}, {0, 1, 2, 0, 2, 3}, place);
}

/// Closed unit cube around the origin, outward faces.
inline void addBox(Scene& scene, const Place& place) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) points.emplace_back((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) - 0.5);
    addPart(scene, points, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                            2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5},
            place);
}

/// Closed unit sphere as an icosahedron split `levels` times: convex, outward faces.
inline void addSphere(Scene& scene, int levels, const Place& place) {
    const double t = std::numbers::phi;
    std::vector<glm::dvec3> points = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                      {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                      {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
    for (glm::dvec3& p : points) p = glm::normalize(p);
    std::vector<std::uint32_t> indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                          4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                          6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto key = std::minmax(a, b);
            const auto [found, isNew] = middles.try_emplace(key, std::uint32_t(points.size()));
            if (isNew) points.push_back(glm::normalize(points[a] + points[b]));
            return found->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
        }
        indices = std::move(finer);
    }
    addPart(scene, points, indices, place);
}

/// A height field of `cells`^2 quads over [-1,1]^2 whose heights are y = amplitude * a sum of waves.
inline void addTerrain(Scene& scene, int cells, double amplitude, const Place& place) {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    for (int z = 0; z <= cells; ++z)
        for (int x = 0; x <= cells; ++x) {
            const double u = 2.0 * x / cells - 1.0, v = 2.0 * z / cells - 1.0;
            points.emplace_back(
                u, amplitude * (std::sin(7.0 * u + 3.0 * v) + 0.5 * std::sin(13.0 * v - 5.0 * u)), v);
        }
    for (int z = 0; z < cells; ++z)
        for (int x = 0; x < cells; ++x) {
            const auto i = std::uint32_t(z * (cells + 1) + x), row = std::uint32_t(cells + 1);
            const auto quad = {i, i + row, i + 1, i + 1, i + row, i + row + 1};
            indices.insert(indices.end(), quad.begin(), quad.end());
        }
    addPart(scene, points, indices, place);
}

/// A random point on triangle `t`, as the ray tracer would report it.
inline glm::dvec3 pointOn(const Scene& scene, std::uint32_t t, double u, double v) {
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const glm::dvec3 a(scene.positions[scene.indices[3 * t]]), b(scene.positions[scene.indices[3 * t + 1]]),
        c(scene.positions[scene.indices[3 * t + 2]]);
    return a + u * (b - a) + v * (c - a);
}

inline glm::dvec3 faceNormal(const Scene& scene, std::uint32_t t) {
    const glm::dvec3 a(scene.positions[scene.indices[3 * t]]), b(scene.positions[scene.indices[3 * t + 1]]),
        c(scene.positions[scene.indices[3 * t + 2]]);
    return glm::normalize(glm::cross(b - a, c - a));
}

/// Of a point of triangle `t` from its nearest edge.
inline double edgeDistance(const Scene& scene, std::uint32_t t, const glm::dvec3& p) {
    double least = 1e300;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const glm::dvec3 a(scene.positions[scene.indices[3 * t + i]]);
        const glm::dvec3 b(scene.positions[scene.indices[3 * t + (i + 1) % 3]]);
        least = std::min(least, glm::length(glm::cross(b - a, p - a)) / glm::length(b - a));
    }
    return least;
}

inline glm::dvec3 randomDirection(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

}  // namespace penumbra::test_meshes
