// Directions in the order in which they are worked through, and which of them need no work.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace penumbra {

/// A direction this near to the horizon of a receiver or below it counts nothing for it: n.l up to here. Its
/// cosine would be small, and its shadow test unsure.
inline constexpr double horizonCosine = 0.02;

/// The same directions, reordered so that neighbours in the list are neighbours on the sphere (halved by the
/// median along the longest axis of their box, down to `leaf`). Deterministic.
std::vector<glm::dvec3> compactOrder(std::vector<glm::dvec3> directions, std::size_t leaf);

/// Around the directions of a batch.
struct DirectionCone {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    /// A receiver with unit normal n and dot(n, axis) at most this has all of them below its horizon. -2: no
    /// receiver has.
    double below = -2.0;
};
DirectionCone coneAround(std::span<const glm::dvec3> directions);

/// The normals of all receivers, so many to a cell: is a direction above anyone's horizon?
class ReceiverHorizons {
 public:
    /// `normals`: unit, or 0 where there is no receiver.
    explicit ReceiverHorizons(std::span<const glm::vec4> normals);
    /// False only if n.toSky is at most horizonCosine for every receiver.
    bool above(const glm::dvec3& toSky) const;

 private:
    struct Box {
        glm::vec3 lower{2.0f}, upper{-2.0f};
    };
    std::vector<Box> boxes_;
};

}  // namespace penumbra
