// Exact shadows in a whole scene: closed forms over the scene's own triangles, without Embree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/scene/scene.h"
#include "common/truth/planar_receiver.h"
#include "common/truth/triangle_bvh.h"

namespace penumbra {

/// "No triangle is left out" / "no part is left out".
inline constexpr std::uint32_t noTriangle = 0xffffffffu;
inline constexpr int noPart = -1;

/// Double-precision queries over the floats of a Scene. Triangles shadow with both sides. What never shadows
/// a point `x`: the triangle `excludedTriangle` it lies on, a part `ignorePart` (a light's own surface), and
/// any triangle in whose plane it lies as far as doubles can tell. Built in O(n log n); then every query may
/// run on many threads.
class ExactScene {
 public:
    explicit ExactScene(const Scene& scene);

    /// Is a triangle strictly between `x` and `target`? Edges shared by two triangles let nothing through.
    bool occluded(const glm::dvec3& x, std::uint32_t excludedTriangle, const glm::dvec3& target,
                  int ignorePart = noPart) const;

    /// What visibleFormFactor (polygon_light.h) gives with all triangles as occluders, to the bit, but
    /// visiting only those that reach into the pyramid over the light. `n` unit; `polygon` convex,
    /// counter-clockwise seen from its front. About 0.4 us for one triangle in the way, 0.5 ms for a thousand
    /// small ones (manyTriangles in tests/bench/truth_bench.cpp).
    double visibleFormFactor(const glm::dvec3& x, const glm::dvec3& n, std::span<const glm::dvec3> polygon,
                             int ignorePart = noPart, std::uint32_t excludedTriangle = noTriangle) const;

    /// The same, or nothing if more than `atMost` triangles reach into one pyramid: found out in little time.
    std::optional<double> visibleFormFactorOfFew(const glm::dvec3& x, const glm::dvec3& n,
                                                 std::span<const glm::dvec3> polygon, std::size_t atMost,
                                                 int ignorePart = noPart,
                                                 std::uint32_t excludedTriangle = noTriangle) const;

    /// visibleFormFactor at the cell centres of a grid on a rectangle, row 0 at v = 0, on all cores; size.x *
    /// size.y values. Triangles in the receiver's plane do not shadow it. Irradiance is pi times the light's
    /// radiance times this.
    std::vector<double> formFactorImage(const PlanarReceiver& receiver, const glm::ivec2& size,
                                        std::span<const glm::dvec3> polygon, int ignorePart = noPart) const;

 private:
    TriangleBvh bvh_;
};

}  // namespace penumbra
