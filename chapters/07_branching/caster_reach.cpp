#include "chapters/07_branching/caster_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/scene/light.h"

namespace penumbra {

namespace {

struct Plane {
    glm::dvec3 point{0.0}, normal{0.0};
};

/// Lower and upper end of the heights of a part's (or all) vertices over `plane`.
glm::dvec2 heights(const Scene& scene, const Plane& plane, std::size_t first, std::size_t count) {
    glm::dvec2 range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for (std::size_t i = first; i < first + count; ++i) {
        const glm::dvec3 p(scene.positions[scene.indices[i]]);
        const double height = glm::dot(plane.normal, p - plane.point);
        range = {std::min(range.x, height), std::max(range.y, height)};
    }
    return range;
}

/// The plane of the first triangle that has one.
Plane planeOf(const Scene& scene, const Part& part) {
    for (std::uint32_t i = 0; i < part.triangleCount; ++i) {
        const std::uint32_t* corner = &scene.indices[3 * std::size_t(part.firstTriangle + i)];
        const glm::dvec3 a(scene.positions[corner[0]]);
        const glm::dvec3 span = glm::cross(glm::dvec3(scene.positions[corner[1]]) - a,
                                           glm::dvec3(scene.positions[corner[2]]) - a);
        if (glm::length(span) > 0.0) return {a, glm::normalize(span)};
    }
    return {};
}

}  // namespace

Floor::Floor(const Scene& scene) : parts_(scene.parts.size(), false) {
    const double flat = 1e-6 * scene.bounds.radius();
    const auto liesIn = [&](const Part& part, const Plane& plane) {
        const glm::dvec2 range =
            heights(scene, plane, 3 * std::size_t(part.firstTriangle), 3 * std::size_t(part.triangleCount));
        return range.x >= -flat && range.y <= flat;
    };
    double largest = 0.0;
    for (const Part& part : scene.parts) {
        Plane plane = planeOf(scene, part);
        const double size = part.bounds.radius();
        if (size <= largest || plane.normal == glm::dvec3(0.0) || !liesIn(part, plane)) continue;
        const glm::dvec2 all = heights(scene, plane, 0, scene.indices.size());
        if (all.x < -flat && all.y > flat) continue;  // something on either side
        if (all.x < -flat) plane.normal = -plane.normal;
        largest = size;
        point_ = plane.point;
        normal_ = plane.normal;
    }
    if (largest == 0.0) return;
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i] = liesIn(scene.parts[i], {point_, normal_});
}

bool Floor::contains(std::size_t part, const Light& light) const {
    return parts_[part] && glm::dot(normal_, directionToLight(light, point_)) > 0.0;
}

CasterReach casterReach(const Scene& scene, const Floor& floor, const Light& light,
                        const LightFrustum& frustum, float margin, int mapSize) {
    glm::dvec2 lower(2.0), upper(-1.0);
    double nearest = std::numeric_limits<double>::infinity();
    const double farther = frustum.range == DepthRange::reversed ? -1.0 : 1.0;
    const glm::dmat4 textureFromWorld = frustum.textureFromWorld();
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        if (int(i) == light.part || floor.contains(i, light)) continue;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 p = textureFromWorld * glm::dvec4(scene.parts[i].bounds.corner(corner), 1.0);
            // Behind the light or before its near plane: the box may reach anywhere.
            if (p.w <= 0.0 || p.z < 0.0 || p.z > p.w) return {{0, 0, 1, 1}, -2.0f};
            const glm::dvec3 str = glm::dvec3(p) / p.w;
            lower = glm::min(lower, glm::dvec2(str));
            upper = glm::max(upper, glm::dvec2(str));
            nearest = std::min(nearest, farther * str.z);
        }
    }
    const double around = (margin + 1.0) / mapSize;
    // A thousandth of the range: far more than rounding.
    return {glm::vec4(lower - around, upper + around), float(std::max(nearest, -2.0) - 1e-3)};
}

}  // namespace penumbra
