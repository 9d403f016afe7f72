// Receivers: the flat polygons of a scene that get a texture of light of their own, one texel per point of an
// evenly spaced grid (Heckbert & Herf, "Simulating Soft Shadows with Graphics Hardware", CMU-CS-97-104,
// 1997).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra {

/// One side of a flat polygon, and the parallelogram corner + u uEdge + v vEdge, u and v in [0,1], that its
/// texture covers. It receives on the side that cross(uEdge, vEdge) points to.
struct Receiver {
    glm::dvec3 corner{0.0};
    glm::dvec3 uEdge{1.0, 0.0, 0.0};
    glm::dvec3 vEdge{0.0, 1.0, 0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};      ///< unit, of the side that receives
    glm::ivec2 texels{1, 1};               ///< along u and v
    double area = 0.0;                     ///< of the polygon, m^2; the parallelogram may be larger
    int part = 0;                          ///< index into Scene::parts
    bool back = false;                     ///< the side that the triangles' winding faces away from
    std::vector<std::uint32_t> triangles;  ///< of the polygon, ascending: indices into Scene::indices / 3

    glm::dvec3 at(const glm::dvec2& uv) const { return corner + uv.x * uEdge + uv.y * vEdge; }
    /// Of the parallelogram, counter-clockwise about the normal.
    std::array<glm::dvec3, 4> corners() const { return {at({0, 0}), at({1, 0}), at({1, 1}), at({0, 1})}; }
    /// Texel (column, row) has its centre at ((column + 1/2) / texels.x, (row + 1/2) / texels.y).
    glm::dvec3 texelCentre(int column, int row) const {
        return at({(column + 0.5) / texels.x, (row + 0.5) / texels.y});
    }
    /// (u, v) of a point of the plane; of any other, of the point below it along the normal.
    glm::dvec2 uv(const glm::dvec3& p) const;
    /// Distance above the plane, metres; negative on the side that does not receive.
    double height(const glm::dvec3& p) const { return glm::dot(normal, p - corner); }
};

/// Which polygons become receivers, and how fine their textures are.
struct ReceiverRequest {
    double minimumArea = 0.05;      ///< m^2; a smaller polygon has no texture
    double texelsPerMetre = 100.0;  ///< along both edges
    std::int64_t budget = 1 << 24;  ///< most texels of all receivers together: finer requests are coarsened
    int maximumSide = 4096;         ///< most texels along one edge
    std::vector<int> lights;        ///< indices into Scene::lights that must be received; empty: all
};

/// Does light from some point of `light` arrive at some point of the receiver's parallelogram, nothing in
/// between? False: the closed form is 0 everywhere, without a sample.
bool receives(const Receiver& receiver, const Light& light);
/// The same of any of these of the scene's lights, by their index.
bool receivesAny(const Receiver& receiver, const Scene& scene, const std::vector<int>& lights);

/// The receivers of `scene`, the largest first. A polygon is a set of triangles of one part that are
/// connected by edges (vertices of equal position taken as one), lie in one plane, and have the plane's
/// normal as their shading normal. Its parallelogram is itself if it is one, else the smallest rectangle
/// around it.
///
/// Surfaces are seen, and lit, from both sides (Material), so each side that light arrives at is a receiver
/// of its own; the other is dark without a texture, and so is the inside of a closed part, which no one sees.
/// A light's own part receives nothing. O(n log n) in the triangles.
std::vector<Receiver> findReceivers(const Scene& scene, const ReceiverRequest& request);

/// How many texels all receivers have together.
std::int64_t texelCount(const std::vector<Receiver>& receivers);

}  // namespace penumbra
