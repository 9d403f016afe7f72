#include "common/truth/surface_hit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra {

namespace {

double distanceToEdges(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = t[(i + 1) % 3] - t[i];
        const double length = glm::length(edge);
        if (length > 0.0) least = std::min(least, glm::length(glm::cross(edge, p - t[i])) / length);
    }
    return least;
}

std::uint32_t partOf(const Scene& scene, std::uint32_t triangle) {
    const auto after =
        std::upper_bound(scene.parts.begin(), scene.parts.end(), triangle,
                         [](std::uint32_t t, const Part& part) { return t < part.firstTriangle; });
    return after == scene.parts.begin() ? 0u : std::uint32_t(after - scene.parts.begin() - 1);
}

}  // namespace

std::array<glm::dvec3, 3> cornersOf(const Scene& scene, std::uint32_t triangle) {
    const std::uint32_t* i = &scene.indices[3 * std::size_t(triangle)];
    return {glm::dvec3(scene.positions[i[0]]), glm::dvec3(scene.positions[i[1]]),
            glm::dvec3(scene.positions[i[2]])};
}

glm::dvec2 exactBarycentrics(const Ray& ray, const std::array<glm::dvec3, 3>& t, const glm::dvec2& fallback) {
    const glm::dvec3 pa = t[0] - ray.origin, pb = t[1] - ray.origin, pc = t[2] - ray.origin;
    const double u = glm::dot(ray.direction, glm::cross(pb, pc));
    const double v = glm::dot(ray.direction, glm::cross(pc, pa));
    const double w = glm::dot(ray.direction, glm::cross(pa, pb));
    const double sum = u + v + w;
    if (!(std::abs(sum) > 0.0)) return fallback;  // edge-on: any point of the crossing line is as good
    const glm::dvec2 b = glm::clamp(glm::dvec2(v, w) / sum, 0.0, 1.0);
    return b.x + b.y > 1.0 ? b / (b.x + b.y) : b;
}

Hit surfaceHit(const Scene& scene, std::uint32_t triangle, const glm::dvec2& barycentric) {
    const std::uint32_t* i = &scene.indices[3 * std::size_t(triangle)];
    const auto [a, b, c] = cornersOf(scene, triangle);
    const double u = barycentric.x, v = barycentric.y;
    Hit hit;
    hit.valid = true;
    hit.triangle = triangle;
    hit.part = partOf(scene, triangle);
    hit.barycentric = barycentric;
    // a + differences, not a weighted sum: on an axis-aligned plane the coordinate then comes out exactly.
    hit.position = a + u * (b - a) + v * (c - a);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    hit.edgeDistance = distanceToEdges(hit.position, {a, b, c});
    hit.geometricNormal = glm::length(n) > 0.0 ? glm::normalize(n) : glm::dvec3(0, 1, 0);
    const glm::dvec3 shading = (1.0 - u - v) * glm::dvec3(scene.normals[i[0]]) +
                               u * glm::dvec3(scene.normals[i[1]]) + v * glm::dvec3(scene.normals[i[2]]);
    hit.shadingNormal = glm::length(shading) > 0.0 ? glm::normalize(shading) : hit.geometricNormal;
    const glm::dvec2 uvA(scene.uvs[i[0]]);
    hit.uv = uvA + u * (glm::dvec2(scene.uvs[i[1]]) - uvA) + v * (glm::dvec2(scene.uvs[i[2]]) - uvA);
    return hit;
}

}  // namespace penumbra
