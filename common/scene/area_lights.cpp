#include "common/scene/area_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>

#include "common/math/polygon.h"
#include "common/scene/convex_merge.h"
#include "common/scene/gltf_limits.h"

namespace penumbra {
namespace {

using TriangleIndices = std::array<std::uint32_t, 3>;

/// The part's triangles over points welded by position; triangles without area are left out.
struct Emitter {
    std::vector<glm::dvec3> points;
    std::vector<TriangleIndices> triangles;
};

Emitter emitterOf(const Scene& scene, const Part& part) {
    Emitter emitter;
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<glm::vec3, std::uint32_t, decltype(less)> known(less);
    for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
        TriangleIndices triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = scene.positions[scene.indices[3 * std::size_t(t) + k]];
            const auto [entry, isNew] = known.try_emplace(p, std::uint32_t(emitter.points.size()));
            if (isNew) emitter.points.push_back(p);
            triangle[k] = entry->second;
        }
        emitter.triangles.push_back(triangle);
    }
    return emitter;
}

glm::dvec3 areaNormalOf(const Emitter& emitter, const TriangleIndices& t) {
    const std::array<glm::dvec3, 3> corners = {emitter.points[t[0]], emitter.points[t[1]],
                                               emitter.points[t[2]]};
    return areaNormal(corners);
}

/// The front normal, if all triangles lie in one plane and face the same way. The floats of a tilted plane
/// are off it by their rounding; ten times that is still flat.
std::optional<glm::dvec3> planeNormal(const Emitter& emitter, const Aabb& bounds) {
    glm::dvec3 sum(0.0);
    for (const TriangleIndices& t : emitter.triangles) sum += areaNormalOf(emitter, t);
    const double length = glm::length(sum);
    const double size = glm::length(bounds.size());
    if (!(length > 1e-12 * size * size)) return std::nullopt;
    const glm::dvec3 normal = sum / length;
    const double far = glm::length(glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper)));
    const double tolerance = 1e-6 * (far + size);
    for (const glm::dvec3& p : emitter.points) {
        if (std::abs(glm::dot(p - emitter.points[0], normal)) > tolerance) return std::nullopt;
    }
    for (const TriangleIndices& t : emitter.triangles) {
        if (glm::dot(areaNormalOf(emitter, t), normal) < -tolerance * size) return std::nullopt;
    }
    return normal;
}

std::vector<std::vector<glm::dvec3>> lightPolygons(const Emitter& emitter, const glm::dvec3& normal) {
    const glm::dvec3 axis = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, normal)), v = glm::cross(normal, u);
    std::vector<glm::dvec2> plane;
    for (const glm::dvec3& p : emitter.points) {
        plane.emplace_back(glm::dot(p - emitter.points[0], u), glm::dot(p - emitter.points[0], v));
    }
    std::vector<std::vector<glm::dvec3>> polygons;
    for (const IndexPolygon& outline : mergeConvex(plane, emitter.triangles, maxLightCorners)) {
        std::vector<glm::dvec3> polygon;
        for (const std::uint32_t i : outline) polygon.push_back(emitter.points[i]);
        polygons.push_back(std::move(polygon));
    }
    return polygons;
}

/// Sets area and centroid from the polygons.
void measure(Light& light) {
    glm::dvec3 weighted(0.0);
    light.area = 0.0;
    for (const auto& polygon : light.polygons) {
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const double area =
                0.5 *
                glm::dot(glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]), light.direction);
            light.area += area;
            weighted +=
                area * ((polygon[i] - polygon[0]) + (polygon[i + 1] - polygon[0])) / 3.0 + area * polygon[0];
        }
    }
    if (light.area > 0.0) light.position = weighted / light.area;
}

}  // namespace

void addAreaLights(Scene& scene) {
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        const Material& material = scene.materials[std::size_t(part.material)];
        if (material.emission == glm::vec3(0.0f)) continue;
        Light light;
        light.name = part.name;
        light.type = LightType::area;
        light.emission = material.emission;
        light.part = int(i);
        if (part.triangleCount <= gltf::maxEmitterTriangles) {
            const Emitter emitter = emitterOf(scene, part);
            if (const auto normal = planeNormal(emitter, part.bounds)) {
                light.direction = *normal;
                light.polygons = lightPolygons(emitter, *normal);
                measure(light);
            }
        }
        if (light.area > 0.0) {
            scene.lights.push_back(std::move(light));
        } else {
            scene.notes.push_back(
                fmt::format("{} glows but is not flat (or too fine): it lights nothing", part.name));
        }
    }
}

}  // namespace penumbra
