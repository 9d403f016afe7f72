#include "chapters/08_accumulation/receiver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chapters/08_accumulation/flat_polygons.h"
#include "common/scene/light.h"

namespace penumbra {

namespace {

/// As far as doubles can tell; a light in the receiver's plane gives nothing.
constexpr double rounding = 1e-12;

Receiver receiverOf(const Scene& scene, const FlatPolygon& polygon, bool back) {
    std::vector<glm::dvec3> points;
    for (const std::uint32_t t : polygon.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            points.emplace_back(scene.positions[scene.indices[3 * std::size_t(t) + k]]);
    const auto [corner, u, v] = parallelogramAround(points, polygon.normal);
    Receiver receiver;
    receiver.corner = corner;
    receiver.uEdge = back ? v : u;
    receiver.vEdge = back ? u : v;
    receiver.normal = glm::normalize(glm::cross(receiver.uEdge, receiver.vEdge));
    receiver.area = polygon.area;
    receiver.back = back;
    receiver.triangles = polygon.triangles;
    return receiver;
}

/// Texels for `perMetre`, none finer.
void setTexels(Receiver& receiver, double perMetre, int maximumSide) {
    const auto along = [&](const glm::dvec3& edge) {
        return int(std::clamp(std::round(glm::length(edge) * perMetre), 1.0, double(maximumSide)));
    };
    receiver.texels = {along(receiver.uEdge), along(receiver.vEdge)};
}

void setTexels(std::vector<Receiver>& receivers, const ReceiverRequest& request) {
    double perMetre = request.texelsPerMetre;
    for (int attempt = 0; attempt < 8; ++attempt) {
        for (Receiver& receiver : receivers) setTexels(receiver, perMetre, request.maximumSide);
        const std::int64_t count = texelCount(receivers);
        if (count <= request.budget) return;
        perMetre *= 0.999 * std::sqrt(double(request.budget) / double(count));
    }
}

}  // namespace

glm::dvec2 Receiver::uv(const glm::dvec3& p) const {
    const glm::dvec3 d = p - corner;
    const glm::dvec3 across = glm::cross(uEdge, vEdge);
    const double square = glm::dot(across, across);
    return {glm::dot(glm::cross(d, vEdge), across) / square, glm::dot(glm::cross(uEdge, d), across) / square};
}

bool receives(const Receiver& receiver, const Light& light) {
    if (light.type == LightType::directional) return glm::dot(receiver.normal, light.direction) < -rounding;
    const double above = rounding * (glm::length(light.position) + glm::length(receiver.corner));
    if (light.type != LightType::area) return receiver.height(light.position) > above;
    bool lightIsAbove = false, isInFront = false;
    for (const auto& polygon : light.polygons)
        for (const glm::dvec3& p : polygon) lightIsAbove = lightIsAbove || receiver.height(p) > above;
    for (int i = 0; i < 4; ++i) {
        const glm::dvec3 corner = receiver.at({i & 1, i >> 1});
        isInFront = isInFront || glm::dot(light.direction, corner - light.position) > above;
    }
    return lightIsAbove && isInFront;
}

bool receivesAny(const Receiver& receiver, const Scene& scene, const std::vector<int>& lights) {
    return std::any_of(lights.begin(), lights.end(),
                       [&](int light) { return receives(receiver, scene.lights[std::size_t(light)]); });
}

std::vector<Receiver> findReceivers(const Scene& scene, const ReceiverRequest& request) {
    std::vector<int> lights = request.lights;
    if (lights.empty()) {
        lights.resize(scene.lights.size());
        std::iota(lights.begin(), lights.end(), 0);
    }
    const auto isLight = [&](int part) {
        return std::any_of(scene.lights.begin(), scene.lights.end(),
                           [&](const Light& light) { return light.part == part; });
    };
    std::vector<Receiver> receivers;
    for (int part = 0; part < int(scene.parts.size()); ++part) {
        if (isLight(part)) continue;
        const Part& surface = scene.parts[std::size_t(part)];
        for (const FlatPolygon& polygon : flatPolygons(scene, surface, request.minimumArea))
            for (const bool back : {false, true}) {
                if (back && surface.closed) continue;
                Receiver receiver = receiverOf(scene, polygon, back);
                receiver.part = part;
                if (receivesAny(receiver, scene, lights)) receivers.push_back(std::move(receiver));
            }
    }
    std::stable_sort(receivers.begin(), receivers.end(),
                     [](const Receiver& a, const Receiver& b) { return a.area > b.area; });
    setTexels(receivers, request);
    return receivers;
}

std::int64_t texelCount(const std::vector<Receiver>& receivers) {
    return std::accumulate(receivers.begin(), receivers.end(), std::int64_t(0),
                           [](std::int64_t sum, const Receiver& receiver) {
                               return sum + std::int64_t(receiver.texels.x) * receiver.texels.y;
                           });
}

}  // namespace penumbra
