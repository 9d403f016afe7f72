// Which planes most of the picture's receivers lie on: from them the minima are measured.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "chapters/01_depth_from_light/light_frustum.h"
#include "common/scene/scene.h"

namespace penumbra {

/// A plane on which triangles lie, with their area. Coplanar triangles count as one.
struct ReceiverPlane {
    glm::dvec3 point{0.0}, normal{0.0};
    double area = 0.0;    ///< m^2
    bool closed = false;  ///< all of closed parts: seen from the front only
};

/// The planes of the largest areas of the scene, largest first, at most `count`. Looks at every triangle.
std::vector<ReceiverPlane> largestPlanes(const Scene& scene, std::size_t count = 64);

/// Slopes of window depth over the whole map, oriented so that larger is farther from the light, of the three
/// planes that receive most light: parallel planes are one under a directional light. What is missing is 0.
std::array<glm::vec2, 3> dominantSlopes(const std::vector<ReceiverPlane>& planes, const LightFrustum& frustum,
                                        const Light& light);

}  // namespace penumbra
