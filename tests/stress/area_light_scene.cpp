#include "tests/stress/area_light_scene.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <span>

#include "common/math/magnitude.h"
#include "common/math/polygon.h"
#include "tests/stress/triangle_shapes.h"

namespace penumbra::stress {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<glm::dvec3> lightAround(const glm::dvec3& centre, double size, Dice& dice) {
    constexpr std::array counts = {4, 3, 5, 10, 11, 64};
    const int count = counts[std::size_t(dice.below(6))];
    const double flat = dice.oneIn(3) ? dice.magnitude(1e-9, 1.0) : 1.0;
    // Now and then seen edge-on from x, nearly.
    const double tilt = dice.oneIn(3) ? 0.5 * pi - dice.magnitude(1e-9, 1.0) : dice.between(0.0, 0.45 * pi);
    const glm::dvec3 normal = glm::normalize(-std::cos(tilt) * centre + std::sin(tilt) * dice.across(centre));
    const glm::dvec3 u = dice.across(normal), v = glm::cross(normal, u);
    std::vector<glm::dvec3> light;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * pi * (i + 0.5) / count;
        light.push_back(centre + 0.5 * size * (std::cos(angle) * u + flat * std::sin(angle) * v));
    }
    return light;
}

/// Of the segment from the origin.
double distanceOf(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double squared = glm::dot(along, along);
    const double t = squared > 0.0 ? std::clamp(-glm::dot(a, along) / squared, 0.0, 1.0) : 0.0;
    return glm::length(a + t * along);
}

double sweptByEdge(const glm::dvec3& a, const glm::dvec3& b, double error) {
    const double nearest = distanceOf(a, b);
    if (!(nearest > 8.0 * error)) return std::numeric_limits<double>::infinity();
    // Each end turns by so much, and the border of a border is no longer than half a turn.
    const double turn = error / nearest;
    const double seen = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    return 2.0 * turn * (seen + turn) / pi;
}

/// Is the origin within `error` of the plane of `polygon`, over its inside?
bool touches(std::span<const glm::dvec3> polygon, double error) {
    const glm::dvec3 normal = areaNormal(polygon);
    const double length = glm::length(normal);
    if (!(length > 0.0) || std::abs(glm::dot(normal, polygon[0])) > error * length) return false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (glm::dot(normal, glm::cross(a, b)) < -error * length * glm::length(b - a)) return false;
    }
    return true;
}

template <class Points>
std::vector<glm::dvec3> seenFrom(const glm::dvec3& x, const Points& points) {
    std::vector<glm::dvec3> relative;
    for (const glm::dvec3& p : points) relative.push_back(p - x);
    return relative;
}

}  // namespace

AreaLightScene areaLightScene(const Case& given) {
    Dice dice(std::uint64_t(given.integer("variant")));
    const double angle = given.number("light-angle") * pi / 180.0, size = given.number("light-size");
    AreaLightScene scene;
    const double azimuth = 2.0 * pi * dice.unit();
    const glm::dvec3 centre(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                            std::cos(angle));
    scene.light = lightAround(centre, size, dice);
    const int groups = 1 + dice.below(2);
    for (int i = 0; i < groups; ++i) {
        // Somewhere on the way, of the width of the light there or of a much smaller one; now and then behind
        // the light, or right before x.
        const double along = dice.oneIn(4) ? dice.magnitude(1e-9, 1.0) : dice.between(0.02, 1.1);
        const double width = along * std::min(size, 1.0) * dice.magnitude(0.02, 2.0);
        const glm::dvec3 plane = dice.oneIn(2) ? scene.normal : dice.across(centre);
        const auto more = trianglesOf(given.choice("shape"),
                                      {along * centre + 0.5 * width * dice.inCube(), width, plane}, dice);
        scene.occluders.insert(scene.occluders.end(), more.begin(), more.end());
    }
    return scene;
}

AreaLightScene moved(const AreaLightScene& scene, const glm::dmat3& turn, double scale,
                     const glm::dvec3& by) {
    const auto move = [&](const glm::dvec3& p) { return scale * (turn * p) + by; };
    AreaLightScene result;
    result.x = move(scene.x);
    result.normal = glm::normalize(turn * scene.normal);
    for (const glm::dvec3& p : scene.light) result.light.push_back(move(p));
    for (const Triangle& t : scene.occluders)
        result.occluders.push_back({move(t[0]), move(t[1]), move(t[2])});
    return result;
}

double largestMagnitude(const AreaLightScene& scene) {
    double largest = sumOfMagnitudes(scene.x);
    for (const glm::dvec3& p : scene.light) largest = std::max(largest, sumOfMagnitudes(p));
    for (const Triangle& t : scene.occluders)
        for (const glm::dvec3& p : t) largest = std::max(largest, sumOfMagnitudes(p));
    return largest;
}

double sweptBy(const AreaLightScene& scene, double error) {
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.light.size(); ++i)
        sum +=
            sweptByEdge(scene.light[i] - scene.x, scene.light[(i + 1) % scene.light.size()] - scene.x, error);
    for (const Triangle& t : scene.occluders)
        for (std::size_t i = 0; i < 3; ++i)
            sum += sweptByEdge(t[i] - scene.x, t[(i + 1) % 3] - scene.x, error);
    return sum;
}

bool onTheEdge(const AreaLightScene& scene, double error) {
    const std::vector<glm::dvec3> light = seenFrom(scene.x, scene.light);
    const glm::dvec3 area = areaNormal(light), normal = glm::normalize(area);
    double across = 0.0;
    for (const glm::dvec3& p : light) across = std::max(across, glm::length(p - light[0]));
    // The plane of a slender light is known the less the farther away one asks for it.
    const double turn = error * across / glm::length(area);
    const auto front = [&](const glm::dvec3& p) { return glm::dot(normal, p - light[0]); };
    const auto unsure = [&](const glm::dvec3& p) { return error + turn * glm::length(p - light[0]); };
    const glm::dvec3 x(0.0);
    if (!(front(x) > unsure(x))) return true;
    for (const Triangle& t : scene.occluders) {
        const std::vector<glm::dvec3> corners = seenFrom(scene.x, t);
        const auto before = [&](const glm::dvec3& p) { return front(p) > unsure(p); };
        const auto behind = [&](const glm::dvec3& p) { return front(p) < -unsure(p); };
        if (!std::ranges::all_of(corners, before) && !std::ranges::all_of(corners, behind)) return true;
        if (touches(corners, error)) return true;
    }
    return false;
}

std::vector<Triangle> cutInThree(const std::vector<Triangle>& occluders, Dice& dice) {
    std::vector<Triangle> parts;
    for (const Triangle& t : occluders) {
        const double u = dice.between(0.1, 0.4), v = dice.between(0.1, 0.4);
        const glm::dvec3 middle = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
        for (std::size_t i = 0; i < 3; ++i) parts.push_back({t[i], t[(i + 1) % 3], middle});
    }
    return parts;
}

}  // namespace penumbra::stress
