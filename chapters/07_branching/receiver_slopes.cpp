#include "chapters/07_branching/receiver_slopes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "common/scene/light.h"

namespace penumbra {

namespace {

/// Planes with equal keys are taken for one.
std::tuple<int, int, int, long> keyOf(const glm::dvec3& normal, const glm::dvec3& point, double size) {
    const glm::dvec3 n = glm::round(normal * 1e4);
    return {int(n.x), int(n.y), int(n.z), std::lround(glm::dot(normal, point) / (1e-5 * size))};
}

/// Share of the light that the plane gets: its area, foreshortened, and farther away smaller on the map.
double lightReceived(const ReceiverPlane& plane, const Light& light) {
    const double cosine = glm::dot(plane.normal, directionToLight(light, plane.point));
    const double facing = plane.closed ? std::max(cosine, 0.0) : std::abs(cosine);
    if (light.type == LightType::directional) return plane.area * facing;
    const glm::dvec3 toLight = light.position - plane.point;
    return plane.area * facing / std::max(glm::dot(toLight, toLight), 1e-12);
}

}  // namespace

std::vector<ReceiverPlane> largestPlanes(const Scene& scene, std::size_t count) {
    std::map<std::tuple<int, int, int, long>, ReceiverPlane> found;
    const double size = std::max(scene.bounds.radius(), 1e-30);
    for (const Part& part : scene.parts) {
        for (std::uint32_t i = 0; i < part.triangleCount; ++i) {
            const std::uint32_t* corner = &scene.indices[3 * std::size_t(part.firstTriangle + i)];
            const glm::dvec3 a(scene.positions[corner[0]]), b(scene.positions[corner[1]]),
                c(scene.positions[corner[2]]);
            const glm::dvec3 span = glm::cross(b - a, c - a);
            const double doubleArea = glm::length(span);
            if (!(doubleArea > 0.0)) continue;
            ReceiverPlane& plane = found[keyOf(span / doubleArea, a, size)];
            if (plane.area == 0.0) plane = {a, span / doubleArea, 0.0, true};
            plane.area += 0.5 * doubleArea;
            plane.closed = plane.closed && part.closed;
        }
    }
    std::vector<ReceiverPlane> planes;
    for (const auto& [key, plane] : found) planes.push_back(plane);
    std::sort(planes.begin(), planes.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    planes.resize(std::min(planes.size(), count));
    return planes;
}

// [begin:dominant-slopes]
std::array<glm::vec2, 3> dominantSlopes(const std::vector<ReceiverPlane>& planes, const LightFrustum& frustum,
                                        const Light& light) {
    const double farther = frustum.range == DepthRange::reversed ? -1.0 : 1.0;
    std::vector<std::pair<double, glm::dvec2>> slopes;  // light received, slope
    for (const ReceiverPlane& plane : planes) {
        const double received = lightReceived(plane, light);
        const glm::dvec2 slope = farther * depthSlope(frustum.textureFromWorld(), plane.point, plane.normal);
        // Edge-on to the light: no slope to speak of, and hardly a receiver.
        if (received <= 0.0 || !(glm::length(slope) < 1e3)) continue;
        const auto same = [&slope](const auto& other) {
            return glm::length(slope - other.second) <= 1e-6 * (1.0 + glm::length(slope));
        };
        const auto known = std::find_if(slopes.begin(), slopes.end(), same);
        if (known == slopes.end())
            slopes.emplace_back(received, slope);
        else
            known->first += received;
    }
    std::sort(slopes.begin(), slopes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::array<glm::vec2, 3> dominant{};
    for (std::size_t i = 0; i < std::min(slopes.size(), dominant.size()); ++i)
        dominant[i] = glm::vec2(slopes[i].second);
    return dominant;
}
// [end:dominant-slopes]

}  // namespace penumbra
