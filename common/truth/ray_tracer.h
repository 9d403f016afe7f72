// The reference ray tracer: Embree (3 or 4) behind three questions. Checked against the closed forms in tests/unit.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "common/scene/camera.h"
#include "common/scene/scene.h"

namespace penumbra {

/// A surface point, recomputed in double from the triangle's barycentrics (never o + t d).
struct Hit {
    bool valid = false;
    std::uint32_t triangle = 0;   ///< index into Scene::indices / 3
    std::uint32_t part = 0;
    glm::dvec3 position{0.0};
    glm::dvec3 geometricNormal{0.0};  ///< unit, by winding (front side)
    glm::dvec3 shadingNormal{0.0};    ///< unit, interpolated
    glm::dvec2 uv{0.0};
    glm::dvec2 barycentric{0.0};
};

class RayTracer {
   public:
    explicit RayTracer(const Scene& scene);
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    /// Nearest surface along the ray (any side), in (0, infinity). `ignorePart`: a light's own surface, -1 none.
    Hit nearest(const Ray& ray, int ignorePart = -1) const;
    /// Is anything strictly between the surface point and `target`? The surface the hit lies on never shadows itself, and
    /// no tuned epsilon is involved.
    bool occluded(const Hit& from, const glm::dvec3& target, int ignorePart = -1) const;
    /// The same towards infinity.
    bool occludedTowards(const Hit& from, const glm::dvec3& direction, int ignorePart = -1) const;

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra
