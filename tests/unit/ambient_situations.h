// The closed forms of common/truth/ambient_forms.h, each with a scene of triangles in which an estimator
// should find it.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "tests/unit/ambient_scene.h"

namespace penumbra {

/// Slope of log rmse against log rays, from and to.
using Slopes = std::array<double, 2>;
/// No sampler does better than N^-3/4 where an edge of any orientation is looked for (Alexander 1990,
/// Combinatorica 10). 240 trials leave a standard deviation of 0.01.
inline constexpr Slopes edges = {-0.80, -0.70};
/// The edges of half of a turn: a net has the right number of points between them, but for one.
inline constexpr Slopes halfTurn = {-1.05, -0.95};
/// No edge at all.
inline constexpr Slopes smooth = {-1.5, -1.1};

/// One closed form, and a scene in which the estimator should find it.
struct Situation {
    std::string name;
    std::function<void(AmbientScene&)> build;
    AmbientForm form;     ///< of the smooth or endless thing
    double built = 1e-6;  ///< how far its triangles may be off from that: float corners, or facets
    AmbientReach reach = {};
    double tilt = 0.0;  ///< of the normal asked for, from that of the surface, towards +x
    Slopes cosineSlopes = edges, uniformSlopes = edges;
    double rounding = 0.0;  ///< what float rays may be off, where sampling is better than that
};

inline void PrintTo(const Situation& situation, std::ostream* out) {
    *out << situation.name;
}

/// A wall of height h at x, reaching `half` to both sides. Its foot is under the ground.
inline void wall(AmbientScene& s, double x, double h, double half) {
    const double y = std::copysign(half, x);
    s.quad({x, y, -0.5}, {x, -y, -0.5}, {x, -y, h}, {x, y, h});
}

/// In a unit sphere that is open from `rim` on, a point `angle` from the bottom. Only the rim has to be where
/// it is: below it the bowl is a little larger than the sphere, so that its facets stay behind the point.
inline void pit(AmbientScene& s, double rim, double angle, std::uint32_t rings = 10,
                std::uint32_t sectors = 128) {
    const auto at = [](double radius, double polar, double turn) {
        return radius * glm::dvec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                   -std::cos(polar));
    };
    const glm::dvec3 point = at(1.0, angle, 0.0);
    const glm::dvec3 x(0.01 * std::cos(angle), 0.0, 0.01 * std::sin(angle)), y(0.0, 0.01, 0.0);
    s.mesh({point - x - y, point + 2.0 * x - y, point - x + 2.0 * y}, {0, 1, 2});
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t r = 0; r <= rings; ++r)
        for (std::uint32_t i = 0; i < sectors; ++i) {
            points.push_back(
                at(r < rings ? 1.02 : 1.0, rim * r / rings, 2.0 * std::numbers::pi * i / sectors));
            const std::uint32_t next = (i + 1) % sectors, above = r * sectors, below = above - sectors;
            if (r > 0) indices.insert(indices.end(), {below + i, above + i, above + next});
            if (r > 1) indices.insert(indices.end(), {below + i, above + next, below + next});
        }
    s.mesh(points, indices);
}

/// A trench of unit radius, up to `rim` from its bottom, of 24 planks 80 long.
inline void trench(AmbientScene& s, double rim, int plank) {
    constexpr int planks = 24;
    constexpr double half = 40.0;
    const auto at = [&](int i, double y) {
        const double angle = rim * (2.0 * i / planks - 1.0);
        return glm::dvec3(std::sin(angle), y, -std::cos(angle));
    };
    const glm::dvec3 centre = 0.5 * (at(plank, 0.0) + at(plank + 1, 0.0));
    const glm::dvec3 along = at(plank + 1, 0.0) - at(plank, 0.0);
    s.mesh({centre - 0.3 * along - glm::dvec3(0, 0.1, 0), centre + 0.3 * along - glm::dvec3(0, 0.1, 0),
            centre + glm::dvec3(0, 0.2, 0)},
           {0, 1, 2});
    for (int i = 0; i < planks; ++i)
        if (i != plank) s.quad(at(i, -half), at(i + 1, -half), at(i + 1, half), at(i, half));
}

inline void disk(AmbientScene& s, const glm::dvec3& centre, double radius) {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    constexpr std::uint32_t corners = 128;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double turn = -2.0 * std::numbers::pi * i / corners;
        points.push_back(centre + radius * glm::dvec3(std::cos(turn), std::sin(turn), 0.0));
        if (i >= 2) indices.insert(indices.end(), {0u, i - 1, i});
    }
    s.mesh(points, indices);
}

inline std::vector<Situation> situations() {
    std::vector<Situation> all;
    const auto onGround = [](const std::function<void(AmbientScene&)>& build) {
        return [build](AmbientScene& s) { s.ground(), build(s); };
    };
    const auto sphere = [&](const char* name, const glm::dvec3& centre) {
        // 1280 facets: their silhouette is within 1 - cos(4 degrees) = 2.4e-3 of the radius.
        all.push_back({name, onGround([=](AmbientScene& s) { s.sphere(centre, 1.0, 3); }),
                       ambientUnderSphere(centre, 1.0), 2.5e-3});
    };
    sphere("SphereOnTheGround", {1.465, 0, 1});  // hides 0.18 of the light
    sphere("SphereAbove", {0.5, 0.3, 1.5});
    sphere("SphereCutByTheHorizon", {1.3, 0, 0.2});
    const auto wedge = [&](const char* name, double from, double to, const AmbientForm& form) {
        all.push_back({name, onGround([=](AmbientScene& s) { s.wedge(from, to); }), form});
    };
    wedge("Wall", -0.2, std::numbers::pi / 4.0, ambientBesideWall(1.0, 1.0));
    wedge("PerpendicularPlanes", -0.2, std::numbers::pi / 2.0,
          ambientBesideWall(1.0, std::numeric_limits<double>::infinity()));
    all.back().uniformSlopes = halfTurn;
    wedge("VGully", std::numbers::pi / 3.0, std::numbers::pi + 0.2, ambientInVGully(std::numbers::pi / 6.0));
    wedge("GullyWall", std::atan2(1.5, 1.0), std::numbers::pi + 0.2, ambientOnGullyWall(1.0, 1.5));
    // Their ends let in (1 + 2)/30 of a quarter turn each.
    all.push_back({"GullyFloor", onGround([](AmbientScene& s) {
                       wall(s, 1.0, 1.5, 30.0);
                       wall(s, -2.0, 1.5, 30.0);
                   }),
                   ambientOnGullyFloor(2.0, 3.0, 1.5), 2.0 * (1.0 + 2.0) / 30.0 / (2.0 * std::numbers::pi)});
    all.push_back({"LowWallNearby", onGround([](AmbientScene& s) { wall(s, 0.1, 0.1, 4.0); }),
                   ambientBesideWall(0.1, 0.1), 2.0 * 0.1 / 4.0 / (2.0 * std::numbers::pi)});
    // Rays start 16 float ulps of a coordinate of 8 above the ground. Its top, 45 degrees up and so near, is
    // that much lower.
    all.back().rounding = 16.0 * 8.0 * 0x1p-23 / (4.0 * std::numbers::sqrt2 * 0.1);
    // Its ends are open, 40 away, and its rims at most 2 apart.
    all.push_back({"Trench", [](AmbientScene& s) { trench(s, 1.2, 18); },
                   ambientInTrench(1.2, 1.2 * 13.0 / 24.0), 2.0 * 2.0 / 40.0 / (2.0 * std::numbers::pi)});
    // The rim's polygon of 128 corners is 4e-4 smaller than the circle.
    all.push_back({"Pit", [](AmbientScene& s) { pit(s, 2.0, 1.2); }, ambientInPit(2.0, 1.2), 4e-4});
    all.push_back({"Disk", onGround([](AmbientScene& s) {
                       disk(s, {0.5, 0, 1}, 1.0);
                   }),
                   ambientUnderDisk(1.0, 1.0, 0.5), 3e-4});
    all.push_back({"Rectangle", onGround([](AmbientScene& s) {
                       s.quad({-1, -0.5, 1}, {-1, 1.5, 1}, {0.5, 1.5, 1}, {0.5, -0.5, 1});
                   }),
                   ambientUnderRectangle({-1, -0.5}, {0.5, 1.5}, 1.0)});
    // A plane alone: all that is hidden is below it.
    all.push_back({"Slope", [](AmbientScene& s) { s.ground(); }, ambientOnSlope(0.5), 0.0, {}, 0.5});
    const auto tall = onGround([](AmbientScene& s) { wall(s, 0.6, 3.0, 3.0); });
    all.push_back({"WallWithinARange", tall, ambientBesideWallWithin(0.6, 2.0), 0.0, {2.0, false}});
    all.push_back({"FadingWall", tall, ambientBesideFadingWall(0.6, 2.0), 0.0, {2.0, true}});
    all.back().cosineSlopes = all.back().uniformSlopes = smooth;
    // A surface 16 float ulps of a coordinate of 8 nearer than it is.
    all.back().rounding = 16.0 * 8.0 * 0x1p-23 / 0.6;
    return all;
}

}  // namespace penumbra
