// The reference ray tracer: Embree (3 or 4) behind three questions. Checked against the closed forms in
// tests/unit.
//
// Self-intersection is handled without an epsilon to tune. Embree sees float rays; its answers are only
// candidates. A shadow ray is begun behind its surface point and lifted off the surface, both by a few times
// what float rounding can do to it (ShadowPacket), so that whatever touches the point is found;
// and every candidate is decided again in double from the exact segment and the exact triangle: the triangle
// the point lies on never counts, and another counts only if its plane has the two ends on different sides,
// by more than the rounding bound of the double computation itself. With an offset alone, one would see light
// leak in where a wall stands on the ground, or acne.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "common/scene/camera.h"
#include "common/scene/scene.h"

namespace penumbra {

/// A surface point, recomputed in double from the triangle's barycentrics (never o + t d).
struct Hit {
    bool valid = false;
    bool fromBehind =
        false;  ///< the eye sees the back of the face, and the normals were flipped (faceTheEye)
    std::uint32_t triangle = 0;  ///< index into Scene::indices / 3
    std::uint32_t part = 0;
    glm::dvec3 position{0.0};
    glm::dvec3 geometricNormal{0.0};  ///< unit, by winding (front side)
    glm::dvec3 shadingNormal{0.0};    ///< unit, interpolated
    glm::dvec2 uv{0.0};
    glm::dvec2 barycentric{0.0};
    double edgeDistance = 0.0;  ///< metres to the nearest edge of the triangle; 0: not known
};

/// One shadow ray of a batch: from a point of `triangle` to `target`, or towards infinity along `target` (any
/// length).
struct ShadowRay {
    static constexpr std::uint32_t noTriangle = 0xffffffffu;

    glm::dvec3 origin{0.0};
    glm::dvec3 target{0.0};  ///< a point, or a direction if towardsInfinity
    glm::dvec3 normal{0.0};  ///< unit normal of the triangle, either side; 0: in free space
    double edgeDistance =
        0.0;  ///< of the origin from the edges of its triangle; 0: not known, which is right but slow
    std::uint32_t triangle =
        noTriangle;  ///< on which the origin lies, and which never blocks; noTriangle: in free space
    bool towardsInfinity = false;

    static ShadowRay from(const Hit& hit, const glm::dvec3& target, bool towardsInfinity = false) {
        return {hit.position, target, hit.geometricNormal, hit.edgeDistance, hit.triangle, towardsInfinity};
    }
};

class RayTracer {
 public:
    /// Keeps a reference to `scene`. The acceleration structure is built by the first question.
    explicit RayTracer(const Scene& scene);
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    /// Nearest surface along the ray (any side), in (0, infinity). `ignorePart`: a light's own surface, -1
    /// none.
    Hit nearest(const Ray& ray, int ignorePart = -1) const;
    /// Is anything strictly between the surface point and `target`? The surface the hit lies on never shadows
    /// itself, and no tuned epsilon is involved.
    bool occluded(const Hit& from, const glm::dvec3& target, int ignorePart = -1) const;
    /// The same towards infinity.
    bool occludedTowards(const Hit& from, const glm::dvec3& direction, int ignorePart = -1) const;
    /// The same for many rays, traced sixteen at a time: blocked[i] becomes 1 or 0. Several times faster when
    /// neighbouring rays are alike. `blocked` must be as long as `rays`.
    void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                  int ignorePart = -1) const;

    const Scene& scene() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra
