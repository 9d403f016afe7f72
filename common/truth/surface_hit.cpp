#include "common/truth/surface_hit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/truth/light_pyramid.h"

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

/// Barycentric coordinates of the point of a triangle's border that is nearest to the line through the origin
/// along `d`. Where float sees the line cross a needle that it passes by, to cut the coordinates off at 0 and
/// 1 would lead far away along the needle.
glm::dvec2 nearestOnBorder(const std::array<glm::dvec3, 3>& p, const glm::dvec3& d) {
    double least = std::numeric_limits<double>::infinity();
    glm::dvec3 nearest(1.0, 0.0, 0.0);
    for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3;
        const glm::dvec3 start = glm::cross(p[std::size_t(i)], d);
        const glm::dvec3 edge = glm::cross(p[std::size_t(next)] - p[std::size_t(i)], d);
        const double squared = glm::dot(edge, edge);
        const double along = squared > 0.0 ? std::clamp(-glm::dot(start, edge) / squared, 0.0, 1.0) : 0.0;
        const glm::dvec3 off = start + along * edge;
        if (!(glm::dot(off, off) < least)) continue;
        least = glm::dot(off, off);
        nearest = glm::dvec3(0.0);
        nearest[i] = 1.0 - along, nearest[next] = along;
    }
    return {nearest.y, nearest.z};
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

glm::dvec2 exactBarycentrics(const Ray& ray, const std::array<glm::dvec3, 3>& t) {
    const std::array<glm::dvec3, 3> p = {t[0] - ray.origin, t[1] - ray.origin, t[2] - ray.origin};
    // Not from cross(p[1], p[2]): see crossTriangle. The point would lie off its ray.
    const double u = glm::dot(ray.direction, edgePlane(p[1], p[2]));
    const double v = glm::dot(ray.direction, edgePlane(p[2], p[0]));
    const double w = glm::dot(ray.direction, edgePlane(p[0], p[1]));
    const double sum = u + v + w;
    const double farthest = std::max({glm::length(p[0]), glm::length(p[1]), glm::length(p[2])});
    const double longest =
        std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
    // Edge-on, or without area, as far as doubles can tell.
    const bool isLine = std::abs(sum) <= 0x1p-48 * glm::length(ray.direction) * farthest * longest;
    if (isLine || std::min({u / sum, v / sum, w / sum}) < 0.0) return nearestOnBorder(p, ray.direction);
    return glm::dvec2(v, w) / sum;
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
