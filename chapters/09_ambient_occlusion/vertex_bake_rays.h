// The rays of one point of a bake.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "common/truth/ray_bundle.h"

namespace penumbra {

/// Sums over rays, in double so that thousands do not lose a bit.
struct RaySums {
    double visibility = 0.0;
    glm::dvec3 bent{0.0};
    double everyOther = 0.0;  ///< the visibility of rays 0, 2, 4 ...

    AmbientValue mean(int count) const { return {visibility / count, bent / double(count)}; }
};

/// A lattice can be traced in two halves: the even half of 2n directions are n that are spread evenly by
/// themselves, and the odd half, with the same seed, lies in between.
enum class LatticePart { whole, even, odd };

/// Traces `rays.count` directions about the point's normal: a Fibonacci lattice, which has a fifth less error
/// than scrambled Sobol points, shifted and turned by `seed`, so that every direction is equally likely. Adds
/// to `traced`: a direction below the point's own triangles costs no ray.
RaySums tracePoint(const RayBundle& bundle, const PointFan& fan, const AmbientRays& rays, std::uint32_t seed,
                   std::int64_t& traced, LatticePart part = LatticePart::whole);

/// What a point that sees the whole hemisphere has, exactly.
AmbientValue wholeSky(const glm::dvec3& normal, Weighting weighting);

}  // namespace penumbra
