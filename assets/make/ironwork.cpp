#include "assets/make/ironwork.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace penumbra::assets {

Mesh railing(double length, double height, double spacing, double barRadius, double rise) {
    Mesh mesh;
    const auto foot = [&](double x) { return Vec3(x, rise * x / length, 0.0); };
    const Vec3 top(0.0, height, 0.0), low(0.0, 0.1, 0.0);
    mesh.append(bar(foot(0.0) + top, foot(length) + top, 2.4 * barRadius, 8));
    mesh.append(bar(foot(0.0) + low, foot(length) + low, 1.4 * barRadius, 6));
    for (const double x : {0.0, length}) {
        mesh.append(bar(foot(x), foot(x) + top, 2.2 * barRadius, 8));
        mesh.append(sphere(4.0 * barRadius, 2), translation(foot(x) + top + Vec3(0.0, 4.0 * barRadius, 0.0)));
    }
    const int count = std::max(1, static_cast<int>(std::lround(length / spacing)));
    for (int i = 1; i < count; ++i) {
        const Vec3 p = foot(length * i / count);
        mesh.append(bar(p + low, p + top, barRadius, 6));
    }
    return mesh;
}

Mesh netWire(double height, double pitch, double wireRadius, bool startsLeft) {
    const int bends = static_cast<int>(std::lround(height / (0.5 * pitch)));
    std::vector<Vec3> curve;
    for (int i = 0; i <= bends; ++i) {
        const double side = (i % 2 == 0) == startsLeft ? -1.0 : 1.0;
        curve.emplace_back(side * 0.5 * pitch, height * i / bends, side * wireRadius);
    }
    return tube(curve, {wireRadius}, 5);
}

Mesh lantern(double size) {
    Mesh mesh;
    const double r = 0.3 * size;
    const double top = -0.3 * size, bottom = -size;
    mesh.append(lathe({{0.0, top},
                       {1.25 * r, top},
                       {1.25 * r, top + 0.03 * size},
                       {0.6 * r, -0.15 * size},
                       {0.25 * r, -0.08 * size},
                       {0.2 * r, 0.0},
                       {0.0, 0.0}},
                      12));
    mesh.append(lathe({{0.75 * r, bottom},
                       {0.9 * r, bottom},
                       {0.9 * r, bottom + 0.03 * size},
                       {0.75 * r, bottom + 0.03 * size}},
                      12, true));
    for (int i = 0; i < 6; ++i) {
        const double angle = glm::two_pi<double>() * i / 6;
        const Vec3 corner(r * std::cos(angle), 0.0, r * std::sin(angle));
        mesh.append(
            bar({0.8 * corner.x, bottom, 0.8 * corner.z}, {corner.x, top, corner.z}, 0.018 * size, 5));
    }
    return mesh;
}

}  // namespace penumbra::assets
