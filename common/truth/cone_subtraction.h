// Cone subtraction: which part of a polygonal light is seen past opaque triangles, in direction space.
//
// The light is cut by the cone from x over each triangle; what lies in no cone is seen. Cones have no depth
// to divide by, so a triangle that crosses the plane through x parallel to the light needs no special case
// (projecting the triangle on the light's plane would divide by a depth that changes sign there: "negative
// projection").
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "common/math/aabb.h"
#include "common/math/polygon.h"

namespace penumbra {

using Triangle = std::array<glm::dvec3, 3>;

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

    bool empty() const { return light.empty(); }
};

/// `polygon`: convex, planar, counter-clockwise seen from its front, at most 12 vertices; `n` unit.
LightPyramid lightPyramid(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon);

/// True only if nothing in `box` reaches into the pyramid. Never true by rounding alone.
bool outside(const LightPyramid& pyramid, const Aabb& box);

/// Form factor of the whole pyramid, and of what is left of it behind `occluders` (world positions). Sums
/// positive terms only, so a deep umbra has no cancellation error, and one triangle over the whole light
/// gives exactly 0.
double unoccludedFormFactor(const LightPyramid& pyramid);
double visibleFormFactor(const LightPyramid& pyramid, std::span<const Triangle> occluders);

/// Sums `formFactorOf(pyramid)` over pieces of `polygon` small enough for one pyramid each (a disk light of
/// 64 corners has 7).
template <class FormFactorOf>
double sumOverPyramids(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                       const FormFactorOf& formFactorOf) {
    constexpr std::size_t most = Polygon3::capacity / 2 - 1;  // the horizon may add one
    if (polygon.size() <= most) {
        const LightPyramid pyramid = lightPyramid(x, n, polygon);
        return pyramid.empty() ? 0.0 : formFactorOf(pyramid);
    }
    double sum = 0.0;
    std::array<glm::dvec3, most> piece;
    piece[0] = polygon[0];
    for (std::size_t first = 1; first + 1 < polygon.size(); first += most - 2) {
        const std::size_t count = std::min(most - 1, polygon.size() - first);
        std::copy_n(polygon.begin() + long(first), count, piece.begin() + 1);
        const LightPyramid pyramid = lightPyramid(x, n, std::span(piece.data(), count + 1));
        if (!pyramid.empty()) sum += formFactorOf(pyramid);
    }
    return sum;
}

}  // namespace penumbra
