// Occlusion rays by the million, for bakers: float all the way, and Embree's answer is final. What keeps a
// surface from shadowing itself is where the rays start (SurfacePoint in
// chapters/09_ambient_occlusion/vertex_bake.h), not a decision in double as in RayTracer: for a picture's
// shadow edge that would be too little, for a mean over hundreds of rays it is plenty, and twice as fast. But
// for triangles so slender that floats do not know their plane (isSlender in the .cpp): they are decided in
// double, or rods would be dark where rays begin on them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <span>

#include "common/scene/scene.h"

namespace penumbra {

struct BundleRay {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f};  ///< unit
};

/// Embree's float copy of a scene's triangles. All queries may run on many threads.
class RayBundle {
 public:
    /// Builds the hierarchy. Throws Error if Embree does not start, or memory is short. Keeps no reference.
    explicit RayBundle(const Scene& scene);
    ~RayBundle();
    RayBundle(const RayBundle&) = delete;
    RayBundle& operator=(const RayBundle&) = delete;

    /// blocked[i] becomes 1 if any triangle is met by rays[i] nearer than `range` metres, else 0. Eight rays
    /// that follow one another are traced side by side: a third faster than one by one if they are alike.
    void blocked(std::span<const BundleRay> rays, float range, std::span<std::uint8_t> blocked) const;
    /// Distance in metres of the first triangle nearer than `range`; infinity if there is none.
    float distance(const BundleRay& ray, float range = std::numeric_limits<float>::infinity()) const;

    /// Memory of the hierarchy, bytes.
    std::size_t bytes() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra
