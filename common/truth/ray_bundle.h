// Occlusion rays by the million, for bakers: float all the way, and Embree's answer is final. What keeps a
// surface from shadowing itself is where the rays start (SurfacePoint in
// chapters/09_ambient_occlusion/vertex_bake.h), not a decision in double as in RayTracer: for a picture's
// shadow edge that would be too little, for a mean over hundreds of rays it is plenty, and twice as fast.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <memory>

#include "common/scene/scene.h"

namespace penumbra {

/// Embree's float copy of a scene's triangles. All queries may run on many threads.
class RayBundle {
 public:
    /// Builds the hierarchy. Throws Error if Embree does not start, or memory is short. Keeps no reference.
    explicit RayBundle(const Scene& scene);
    ~RayBundle();
    RayBundle(const RayBundle&) = delete;
    RayBundle& operator=(const RayBundle&) = delete;

    /// Is any triangle met from `origin` along `direction` (unit) nearer than `range` metres?
    bool blocked(const glm::vec3& origin, const glm::vec3& direction,
                 float range = std::numeric_limits<float>::infinity()) const;
    /// Distance in metres of the first triangle nearer than `range`; infinity if there is none.
    float distance(const glm::vec3& origin, const glm::vec3& direction,
                   float range = std::numeric_limits<float>::infinity()) const;

    /// Memory of the hierarchy, bytes.
    std::size_t bytes() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra
