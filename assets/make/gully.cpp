// Valleys whose ambient visibility is known in closed form: a rectangular gully, a V gully, a circular trench
// (all 20 m long, so that in the middle they are as good as endless) and a spherical pit.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/make/scenes.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {
namespace {

constexpr double bottom = -1.5, length = 20.0;

// Straight run to `end` in `pieces`, so that values baked per vertex can vary along it.
void lineTo(Polygon& profile, const Vec2& end, int pieces) {
    const Vec2 start = profile.back();
    for (int i = 1; i <= pieces; ++i) profile.push_back(start + (end - start) * (double(i) / pieces));
}

// The ground is walked from right to left, so that the profile runs counter-clockwise.
Polygon groundProfile() {
    Polygon p{{-6.0, bottom}, {5.0, bottom}, {5.0, 0.0}};
    lineTo(p, {3.75, 0.0}, 5);
    constexpr int arcPieces = 24;
    for (int i = 1; i <= arcPieces; ++i) {  // circular trench: radius 0.75 around (3, 0)
        const double angle = glm::pi<double>() * i / arcPieces;
        p.emplace_back(3.0 + 0.75 * std::cos(angle), -0.75 * std::sin(angle));
    }
    lineTo(p, {0.75, 0.0}, 6);
    lineTo(p, {0.0, -1.0}, 10);  // V gully: tan(half opening) = 0.75
    lineTo(p, {-0.75, 0.0}, 10);
    lineTo(p, {-3.0, 0.0}, 9);
    lineTo(p, {-3.0, -1.0}, 8);  // rectangular gully: 1 wide, 1 deep
    lineTo(p, {-4.0, -1.0}, 8);
    lineTo(p, {-4.0, 0.0}, 8);
    lineTo(p, {-6.0, 0.0}, 8);
    return p;
}

// Points around (6.5, y, 0), on a circle of `radius` or on the square of half side 1.5.
Ring ringAround(double radius, double y, bool isSquare) {
    Ring ring;
    for (int j = 0; j < 48; ++j) {
        const double angle = glm::two_pi<double>() * j / 48, c = std::cos(angle), s = std::sin(angle);
        const double r = isSquare ? 1.5 / std::max(std::abs(c), std::abs(s)) : radius;
        ring.emplace_back(6.5 + r * c, y, -r * s);
    }
    return ring;
}

// A cap of the sphere of radius 1 around (6.5, 0.6, 0): rim radius 0.8, depth 0.4.
Mesh pitBlock() {
    // The underside is a fan around its middle: a fan from a corner of the square would have triangles of
    // area 0.
    std::vector<Ring> rings{ringAround(0.0, bottom, false), ringAround(0.0, bottom, true),
                            ringAround(0.0, 0.0, true)};
    for (const double radius : {1.25, 1.0}) rings.push_back(ringAround(radius, 0.0, false));
    constexpr int rows = 14;
    const double rimAngle = std::acos(0.6);
    for (int i = rows; i >= 0; --i) {
        const double angle = rimAngle * i / rows;
        rings.push_back(ringAround(std::sin(angle), i == rows ? 0.0 : 0.6 - std::cos(angle), false));
    }
    return loft(rings);
}

// Pieces that lie side by side become one body, with the same vertices on both sides of a seam and no walls
// inside. A wall would be as near to the eye as the ground where the two meet: a pixel here and there showed
// it.
Mesh joined(const std::vector<Mesh>& pieces) {
    Mesh body;
    for (const Mesh& piece : pieces) {
        Mesh part = welded(piece);
        for (const Mesh& other : pieces) part = sharingVertices(part, welded(other));
        body.append(part);
    }
    const auto isInside = [&](const glm::uvec3& t) {
        const Vec3 a = body.positions[t.x], b = body.positions[t.y], c = body.positions[t.z];
        const Vec3 lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
        return (lower.x == 5.0 && upper.x == 5.0) || (lower.z == upper.z && std::abs(lower.z) == 1.5);
    };
    std::erase_if(body.triangles, isInside);
    return body;
}

}  // namespace

GlbWriter makeGully() {
    GlbWriter scene("gully");
    scene.camera("camera", looking({2.4, 9.0, 7.6}, {1.9, -0.8, -0.3}), 52.0, 0.1, 80.0);
    // From far above, so that the middle row of the picture is a cut across all four at z = 0.
    scene.camera("above", looking({1.0, 60.0, 0.0}, {1.0, 0.0, 0.0}), 10.3, 40.0, 80.0);
    scene.sun("sun", {0.55, -0.75, -0.4}, {3.2, 2.9, 2.5});
    scene.point("lamp", {4.6, 2.4, 1.2}, {8.0, 7.0, 5.5});
    const int sand = scene.material({.name = "sand", .colour = {0.64, 0.55, 0.43}, .roughness = 0.95});
    const Mesh gullies = extrude(groundProfile(), -0.5 * length, 0.5 * length, 40);
    const Mesh before = box({5.0, bottom, 1.5}, {8.0, 0.0, 0.5 * length});
    const Mesh behind = box({5.0, bottom, -0.5 * length}, {8.0, 0.0, -1.5});
    scene.add("ground", {joined({gullies, pitBlock(), before, behind}), sand, 30.0});
    scene.extras(
        R"({"note": "ground at y = 0; gullies run along z from -10 to 10; the profile's arcs are inscribed",
        "rectangular gully": {"x": [-4.0, -3.0], "depth": 1.0},
        "V gully": {"x": [-0.75, 0.75], "depth": 1.0, "tangent of half opening": 0.75},
        "circular trench": {"centre": [3.0, 0.0], "radius": 0.75, "arc half-angle in degrees": 90.0},
        "spherical pit": {"centre": [6.5, 0.6, 0.0], "radius": 1.0, "cosine of arc half-angle": 0.6}})");
    return scene;
}

}  // namespace penumbra::assets
