#include "assets/make/masonry.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace penumbra::assets {
namespace {

constexpr int archSegments = 18;

// From (centre - radius) over the top to (centre + radius), both ends included.
void appendArch(Polygon& polygon, double centre, double spring, double radius) {
    for (int i = 0; i <= archSegments; ++i) {
        const double angle = glm::pi<double>() * (1.0 - static_cast<double>(i) / archSegments);
        polygon.emplace_back(centre + radius * std::cos(angle), spring + radius * std::sin(angle));
    }
}

}  // namespace

Mesh arcadeWall(const Arcade& arcade) {
    const double radius = 0.5 * arcade.bay - arcade.pier, length = arcade.bays * arcade.bay;
    Polygon polygon{{0.0, arcade.spring}};
    for (int i = 0; i < arcade.bays; ++i) appendArch(polygon, (i + 0.5) * arcade.bay, arcade.spring, radius);
    polygon.emplace_back(length, arcade.spring);
    polygon.emplace_back(length, arcade.top);
    polygon.emplace_back(0.0, arcade.top);
    return extrude(polygon, -0.5 * arcade.thickness, 0.5 * arcade.thickness);
}

Mesh archMoulding(const Arcade& arcade) {
    const double radius = 0.5 * arcade.bay - arcade.pier;
    Polygon polygon;
    appendArch(polygon, 0.0, arcade.spring, radius - 0.01);
    Polygon outer;
    appendArch(outer, 0.0, arcade.spring, radius + 0.13);
    polygon.insert(polygon.end(), outer.rbegin(), outer.rend());
    return extrude(polygon, -0.5 * arcade.thickness - 0.05, 0.5 * arcade.thickness + 0.05);
}

Mesh column(double height, double radius) {
    const double r = radius, h = height;
    return lathe({{0.0, 0.1},           {1.45 * r, 0.1},     {1.55 * r, 0.14},     {1.45 * r, 0.18},
                  {1.2 * r, 0.19},      {1.15 * r, 0.22},    {1.3 * r, 0.25},      {1.2 * r, 0.285},
                  {1.0 * r, 0.3},       {1.02 * r, 0.3 * h}, {0.97 * r, 0.6 * h},  {0.86 * r, h - 0.36},
                  {1.0 * r, h - 0.35},  {1.0 * r, h - 0.32}, {0.88 * r, h - 0.31}, {0.95 * r, h - 0.25},
                  {1.15 * r, h - 0.18}, {1.5 * r, h - 0.11}, {1.55 * r, h - 0.08}, {0.0, h - 0.08}},
                 18);
}

Mesh columnBlocks(double height, double radius) {
    const double w = 1.75 * radius;
    Mesh mesh = chamferedBox({-w, 0.0, -w}, {w, 0.1, w}, 0.015);
    return mesh.append(box({-w, height - 0.08, -w}, {w, height, w}));
}

Mesh stairs(int steps, double rise, double run, double width, double landing) {
    Polygon side{{0.0, 0.0}, {steps * run + landing, 0.0}, {steps * run + landing, steps * rise}};
    for (int i = steps - 1; i >= 0; --i) {
        side.emplace_back(i * run, (i + 1) * rise);
        if (i > 0) side.emplace_back(i * run, i * rise);
    }
    // Turns the profile's x into -z, and the extrusion into x.
    return transformed(extrude(side, 0.0, width), rotation(90.0, {0, 1, 0}));
}

std::vector<Mesh> paving(Random& random, const Vec2& lower, const Vec2& upper, int tints) {
    constexpr double gap = 0.006, chamfer = 0.008, depth = 0.06;
    std::vector<Mesh> meshes(static_cast<std::size_t>(tints));
    double z = lower.y;
    while (z < upper.y - 1e-9) {
        double nextZ = z + random.uniform(0.45, 0.8);
        if (upper.y - nextZ < 0.4) nextZ = upper.y;
        double x = lower.x - random.uniform(0.0, 0.4);
        while (x < upper.x - 1e-9) {
            double nextX = x + random.uniform(0.5, 1.15);
            if (upper.x - nextX < 0.4) nextX = upper.x;
            const Vec3 low(std::max(x, lower.x) + gap, -depth, z + gap), high(nextX - gap, 0.0, nextZ - gap);
            if (high.x - low.x > 0.1)
                meshes[static_cast<std::size_t>(random.below(tints))].append(
                    chamferedBox(low, high, chamfer));
            x = nextX;
        }
        z = nextZ;
    }
    return meshes;
}

Mesh barrelTile(double length, double radius) {
    Polygon polygon;
    constexpr int segments = 6;
    for (int i = 0; i <= segments; ++i) {
        const double angle = glm::pi<double>() * i / segments;
        polygon.emplace_back(radius * std::cos(angle), 0.75 * radius * std::sin(angle));
    }
    return transformed(extrude(polygon, 0.0, length), translation({0.0, 0.0, -length}));
}

Mesh basin(int sides, double radius, double height, double wall) {
    return lathe({{0.0, 0.0},
                  {radius * 1.06, 0.0},
                  {radius * 1.06, 0.1},
                  {radius, 0.14},
                  {radius, height - 0.12},
                  {radius * 1.05, height - 0.08},
                  {radius * 1.05, height - 0.02},
                  {radius * 1.03, height},
                  {radius - wall, height},
                  {radius - wall, 0.12},
                  {0.0, 0.12}},
                 sides);
}

Mesh pot(double height, double radius) {
    const double r = radius, h = height;
    return lathe({{0.0, 0.0},
                  {0.62 * r, 0.0},
                  {0.68 * r, 0.04 * h},
                  {0.9 * r, 0.8 * h},
                  {1.0 * r, 0.82 * h},
                  {1.04 * r, 0.86 * h},
                  {1.04 * r, 0.96 * h},
                  {1.0 * r, h},
                  {0.9 * r, h},
                  {0.86 * r, 0.9 * h},
                  {0.0, 0.91 * h}},
                 20);
}

}  // namespace penumbra::assets
