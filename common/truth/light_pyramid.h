// The pyramid from a receiver point over a polygonal light: the part of space where shadows of that light
// come from, and the light as the point sees it.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <span>

#include "common/math/aabb.h"
#include "common/math/magnitude.h"
#include "common/math/polygon.h"

namespace penumbra {

/// What one pyramid has room for: a quadrant of the light may have two corners more.
inline constexpr std::size_t cornersOfALight = Polygon3::capacity / 2 - 2;
/// A light is wide, and summed up in quadrants, if a corner is farther than so many heights.
inline constexpr double heightsOfAWideLight = 16.0;

/// The pyramid from a receiver point over a light polygon, above the receiver's horizon: only what reaches
/// into it can shadow.
struct LightPyramid {
    Polygon3 light;   ///< relative to x, cut at the horizon; empty: x sees nothing of the front side
    Polygon3 inward;  ///< normals of the planes through x that bound the pyramid (not unit), the horizon last
    glm::dvec3 x{0.0};
    glm::dvec3 normal{0.0};       ///< unit receiver normal
    glm::dvec3 lightNormal{0.0};  ///< unit, front side
    double height = 0.0;          ///< of x over the light's plane, > 0
    double rounding =
        0.0;  ///< positions below this distance from a plane are on it, as far as doubles can tell
    /// The height is below a sixteenth of the distance to the farthest corner. Over its foot x then sees
    /// edges of nearly 180 degrees, and their planes are as uncertain as their ends times the distance over
    /// the height: parts cut in different ways would no longer fit together (cracks of 1e-13 at a height of
    /// 1e-4). Such a light is dealt with in quadrants.
    bool wide = false;

    bool empty() const { return light.empty(); }
};

/// One of the four parts into which two planes through x and its foot on the light's plane cut a light. Two
/// directions in one part are at most 90 degrees apart, so an edge's plane is as accurate as its ends,
/// however near x is to the light.
enum class Quadrant { first, second, third, fourth, all };

/// `polygon`: convex, planar, counter-clockwise seen from its front, at most 10 vertices; `n` unit.
LightPyramid lightPyramid(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                          Quadrant quadrant = Quadrant::all);

/// True only if nothing in `box` reaches into the pyramid. Never true by rounding alone.
bool outside(const LightPyramid& pyramid, const Aabb& box);

/// a x b up to a factor of 2, with two properties the plain product lacks: exactly negated when a and b swap,
/// so neighbouring triangles share their cone planes to the bit; and accurate for short far edges, since b -
/// a is formed first. For a and b about equally far from x.
inline glm::dvec3 edgePlane(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::cross(a + b, b - a);
}

/// Form factor of `part`, a part of the pyramid's light: Lambert's formula, for any distances of its corners.
double formFactorOf(const LightPyramid& pyramid, const Polygon3& part);

/// Sums `valueOf(pyramid)` over the pyramids of a light of at most 10 corners: one, or four if it is wide.
template <class ValueOf>
double sumOverQuadrants(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                        const ValueOf& valueOf) {
    const LightPyramid whole = lightPyramid(x, n, polygon);
    if (whole.empty()) return 0.0;
    if (!whole.wide) return valueOf(whole);
    double sum = 0.0;
    for (const Quadrant q : {Quadrant::first, Quadrant::second, Quadrant::third, Quadrant::fourth}) {
        const LightPyramid part = lightPyramid(x, n, polygon, q);
        if (!part.empty()) sum += valueOf(part);
    }
    return sum;
}

/// The same for any number of corners: over pieces of `polygon` small enough for one pyramid each (a disk
/// light of 64 corners has 8).
template <class ValueOf>
double sumOverPyramids(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                       const ValueOf& valueOf) {
    constexpr std::size_t most = cornersOfALight;
    if (polygon.size() <= most) return sumOverQuadrants(x, n, polygon, valueOf);
    double sum = 0.0;
    std::array<glm::dvec3, most> piece;
    piece[0] = polygon[0];
    for (std::size_t first = 1; first + 1 < polygon.size(); first += most - 2) {
        const std::size_t count = std::min(most - 1, polygon.size() - first);
        std::copy_n(polygon.begin() + long(first), count, piece.begin() + 1);
        sum += sumOverQuadrants(x, n, std::span(piece.data(), count + 1), valueOf);
    }
    return sum;
}

}  // namespace penumbra
