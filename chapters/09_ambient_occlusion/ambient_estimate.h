// What a surface point sees of the sky: ambient visibility and the bent vector, by rays.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "common/truth/ray_tracer.h"

namespace penumbra {

/// How directions of the hemisphere count. cosine: by the irradiance they bring, E = pi A L under a uniform
/// sky; uniform: by solid angle, what counting rays of equal density gives. They differ: in a corner of two
/// planes the bent normals are tilted by 32.48 and 45 degrees.
enum class Weighting { cosine, uniform };

/// Which occluders count. hard: those nearer than `range`; smooth: 1 - (1 - d/range)^2 of a direction is open
/// when its nearest surface is d away (obscurance; Zhukov, Iones & Kronin 1998, EGWR). Infinite range: all,
/// and no falloff.
struct AmbientReach {
    double range = std::numeric_limits<double>::infinity();  ///< metres
    bool smooth = false;
};

/// How open is a direction whose nearest surface is `distance` metres away, by the smooth falloff?
double openAt(double distance, const AmbientReach& reach);

/// With V(w) in [0,1], how open direction w is, over the hemisphere about n:
/// cosine:  visibility = 1/pi int V (n.w) dw,   bent = 1/pi int V w (n.w) dw   (open: 1 and (2/3) n)
/// uniform: visibility = 1/2pi int V dw,        bent = 1/2pi int V w dw        (open: 1 and (1/2) n)
struct AmbientValue {
    double visibility = 1.0;
    glm::dvec3 bent{0.0};  ///< not normalised: (visibility, bent) together reproduce every linear sky exactly
};

/// Direction of `bent`; where nothing is seen it has none, and the normal is returned: never NaN.
glm::dvec3 bentNormal(const AmbientValue& value, const glm::dvec3& normal);

/// How many rays, and how they are spread.
struct AmbientRays {
    int count = 64;
    Weighting weighting = Weighting::cosine;
    AmbientReach reach;
    /// The caller knows that no surface within reach rises above the plane of the triangle, on the side
    /// looked from (OpenPlanes): no ray is traced, and the answer is the same to the bit.
    bool nothingAbove = false;
};

/// One direction of an estimate. All of them count the same: each mean below is a plain one.
struct AmbientDirection {
    glm::dvec3 direction{0.0};
    double open = 0.0;  ///< V of AmbientValue: 0 blocked, 1 open, between only with a smooth falloff
};

/// How open each of `directions` (unit, above the surface) is, as AmbientDirection::open. Adds the rays that
/// were traced to `traced`.
std::vector<double> openShares(const RayTracer& tracer, const Hit& from,
                               std::span<const glm::dvec3> directions, const AmbientReach& reach,
                               std::int64_t& traced);

/// Sets `open` of directions, unit and in world space, for which it is 0. As below, whatever their number.
void traceDirections(const RayTracer& tracer, const Hit& from, const AmbientRays& rays,
                     std::span<AmbientDirection> directions, std::int64_t& traced);

/// `rays.count` Owen-scrambled Sobol directions about `normal` (unit, on the side looked from), scrambled by
/// `seed`, and how open each is. Directions below the surface itself, by from.geometricNormal (on that side
/// too, as faceTheEye leaves it), are blocked and cost nothing. Adds the rays that were traced to `traced`.
std::vector<AmbientDirection> castAmbientRays(const RayTracer& tracer, const Hit& from,
                                              const glm::dvec3& normal, const AmbientRays& rays,
                                              std::uint32_t seed, std::int64_t& traced);

/// Means of the openness, and of the openness times the direction.
AmbientValue averageOf(std::span<const AmbientDirection> directions);

/// Both at once.
AmbientValue estimateAmbient(const RayTracer& tracer, const Hit& from, const glm::dvec3& normal,
                             const AmbientRays& rays, std::uint32_t seed, std::int64_t& traced);

}  // namespace penumbra
