// A trefoil knot of 70 000 triangles and 35 000 vertices over a plane: one big smooth mesh that shadows
// itself. Or of any other number, to see how the work grows with it.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/make/scenes.h"
#include "assets/make/shapes.h"

namespace penumbra::assets {
namespace {

/// Quads as long as they are wide, whatever their number.
constexpr double ringsPerSide = 1000.0 / 35.0;

Mesh trefoil(int triangles, double tubeRadius) {
    const int around = std::max(3, int(std::lround(std::sqrt(0.5 * triangles / ringsPerSide))));
    const int along = int(std::lround(0.5 * triangles / around));
    std::vector<Vec3> curve;
    for (int i = 0; i < along; ++i) {
        const double t = glm::two_pi<double>() * i / along;
        const double r = 2.0 + std::cos(3.0 * t);
        curve.emplace_back(r * std::cos(2.0 * t), r * std::sin(2.0 * t), -1.2 * std::sin(3.0 * t));
    }
    return tube(curve, {tubeRadius}, around, true);
}

}  // namespace

GlbWriter makeKnot(int triangles) {
    GlbWriter scene("knot");
    scene.camera("camera", looking({1.2, 3.3, 8.2}, {0.0, 1.5, 0.0}), 36.0, 0.1, 50.0);
    scene.sun("sun", {0.6, -0.75, -0.4}, {3.2, 2.9, 2.5});
    const int glow = scene.material({.name = "light", .colour = Vec3(0.0), .radiance = {7.0, 8.0, 9.0}});
    scene.add("area light", {openQuad({1.4, 4.8, 0.2}, {3.2, 4.8, 0.2}, {3.2, 4.8, 2.0}, {1.4, 4.8, 2.0}),
                             glow, 0.0, Surface::open});

    const int floor = scene.material({.name = "floor", .colour = {0.55, 0.56, 0.6}, .roughness = 0.85});
    const int glaze = scene.material({.name = "glaze", .colour = {0.6, 0.24, 0.1}, .roughness = 0.35});
    scene.add("floor", {box({-7.0, -0.25, -7.0}, {7.0, 0.0, 7.0}), floor});

    Mesh knot = transformed(trefoil(triangles, 0.42), scaling(Vec3(0.58)) * rotation(-38.0, {1, 0, 0}));
    const auto lower = [](const Vec3& a, const Vec3& b) { return a.y < b.y; };
    const double bottom = std::min_element(knot.positions.begin(), knot.positions.end(), lower)->y;
    knot = transformed(knot, translation({0.0, -bottom, 0.0}));
    scene.add("knot", {knot, glaze, 60.0});
    scene.extras(R"({"note": "the knot's lowest vertex touches y = 0"})");
    return scene;
}

}  // namespace penumbra::assets
