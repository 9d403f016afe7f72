// A rectangle that receives light: the receiver of every closed-form picture.
#pragma once

#include <glm/glm.hpp>

namespace penumbra {

/// The rectangle corner + u uEdge + v vEdge, u and v in [0,1]; the edges perpendicular, in metres. It
/// receives on the side that cross(uEdge, vEdge) points to.
struct PlanarReceiver {
    glm::dvec3 corner{0.0};
    glm::dvec3 uEdge{1.0, 0.0, 0.0};
    glm::dvec3 vEdge{0.0, 1.0, 0.0};

    glm::dvec3 normal() const { return glm::normalize(glm::cross(uEdge, vEdge)); }
    glm::dvec3 at(const glm::dvec2& uv) const { return corner + uv.x * uEdge + uv.y * vEdge; }
    /// (u, v) of the foot of a perpendicular from `p`.
    glm::dvec2 uv(const glm::dvec3& p) const {
        const glm::dvec3 d = p - corner;
        return {glm::dot(d, uEdge) / glm::dot(uEdge, uEdge), glm::dot(d, vEdge) / glm::dot(vEdge, vEdge)};
    }
    /// Centre of cell (column, row) of a grid of `size` cells; row 0 at v = 0.
    glm::dvec3 cellCentre(int column, int row, const glm::ivec2& size) const {
        return at({(column + 0.5) / size.x, (row + 0.5) / size.y});
    }
};

}  // namespace penumbra
