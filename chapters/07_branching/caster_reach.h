// Where on the map anything stands that could cast a shadow: beside it no look-up is needed.
#pragma once

#include <glm/glm.hpp>

#include "chapters/01_depth_from_light/light_frustum.h"
#include "common/scene/scene.h"

namespace penumbra {

/// The parts that lie in one plane with the whole scene on its light's side: a floor. It can shadow nothing,
/// so it is no caster, and no caster's box is worth its size. At most one plane: where two meet, each is seen
/// by kernels that lie on the other.
class Floor {
 public:
    /// The largest such plane. Looks at every vertex.
    explicit Floor(const Scene& scene);
    /// Does `part` belong to the floor, as the light sees it?
    bool contains(std::size_t part, const Light& light) const;

 private:
    std::vector<bool> parts_;
    glm::dvec3 point_{0.0}, normal_{0.0};  ///< towards the scene; 0: there is no floor
};

/// Bounds of all casters on the map.
struct CasterReach {
    glm::vec4 st{0.0f, 0.0f, 1.0f, 1.0f};  ///< lower and upper corner; lower > upper: no casters at all
    float nearest = 0.0f;  ///< oriented window depth (larger is farther); what is nearer is lit
};

/// `margin`: of the kernel, texels of a map of `mapSize`.
CasterReach casterReach(const Scene& scene, const Floor& floor, const Light& light,
                        const LightFrustum& frustum, float margin, int mapSize);

}  // namespace penumbra
