// What a surface point sees of the sky, with half of the rays where open and blocked directions meet.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"

namespace penumbra {

/// As estimateAmbient, with at most `rays.count` rays, but in two rounds: one ray in each cell of a grid over
/// the hemisphere, and the other half in the cells whose neighbours do not agree. There is all of the error,
/// and it falls faster than the N^(-3/4) of rays spread evenly: at 4096 rays it is less than half of it, at
/// 1024 about as large, with fewer it is larger. The mean is right whatever is seen, since what is done with
/// a cell's first ray depends on no ray of its own cell. (Rays where neighbours differ: Mitchell
/// 1987, SIGGRAPH; why the first ones must not count there: Kirk & Arvo 1991, SIGGRAPH.)
///
/// `rays.count` at least 2. Where nothing disagrees, as on open ground, the second half is not traced. Adds
/// to `asked` the rays that were traced, or with rays.nothingAbove those that would have been.
AmbientValue estimateAtEdges(const RayTracer& tracer, const Hit& from, const glm::dvec3& normal,
                             const AmbientRays& rays, std::uint32_t seed, std::int64_t& asked);

}  // namespace penumbra
