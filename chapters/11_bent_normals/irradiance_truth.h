// What the sky really gives to a point: rays, rays, rays.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "chapters/09_ambient_occlusion/sky.h"
#include "chapters/11_bent_normals/sky_density.h"
#include "common/app/chapter.h"

namespace penumbra {

/// E = int V L (n.w) dw at a surface point: half of `rays` (at least 2) by the cosine, half where the sky is
/// bright, each weighted by the sum of both densities (the balance heuristic; Veach & Guibas 1995, SIGGRAPH).
/// Unbiased, and a small sun costs no more rays than a cloudy sky. Directions below the surface itself are
/// blocked; of the others, as much as `reach` says.
glm::dvec3 tracedIrradiance(const RayTracer& tracer, const Hit& from, const Sky& sky,
                            const SkyDensity& density, int rays, std::uint32_t seed,
                            const AmbientReach& reach = {});

/// That for each pixel, 3 channels. `method` tells the standard error of the picture, from two halves of the
/// rays. rays.weighting is ignored: light arrives by the cosine.
TruthImage irradianceTruth(const TruthRequest& request, const Sky& sky, const AmbientRays& rays);

/// The bent normal of each pixel as a colour, 0.5 + 0.5 B, as the view shows it; undefined where nothing is
/// seen.
TruthImage bentNormalTruth(const TruthRequest& request, const AmbientRays& rays);

}  // namespace penumbra
