// Exact answers for whole pictures: what `--compare-truth` compares with.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/scene/scene.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

/// fraction in [0,1] done; called from time to time, from one thread at a time.
using ProgressCallback = std::function<void(double fraction)>;

struct TruthImage {
    FloatImage value;        ///< exact values, 1 or 3 channels
    FloatImage mask;         ///< 1 channel: 1 where the answer is defined, else 0
    std::string quantity;    ///< "visibility", "depth", "irradiance"
    std::string method;      ///< "closed form" or "ray traced"
    std::string against;     ///< "point light", "area light", "filter"
    std::size_t background = 0;   ///< pixels left out: no surface
    std::size_t facingAway = 0;   ///< ... : n.l <= 0
    std::size_t straddling = 0;   ///< ... : the camera's pixel straddles a silhouette (its corners see other surfaces)
};

/// What the camera sees at each pixel's centre, top row first. `straddling[i]`: the pixel's corners do not all see the same
/// part at about the same depth and normal, so its value is undefined.
struct PrimaryHits {
    glm::ivec2 size{0};
    std::vector<Hit> hits;
    std::vector<std::uint8_t> straddling;
};
PrimaryHits primaryHits(const RayTracer& tracer, const Camera& camera, const glm::ivec2& size,
                        const ProgressCallback& progress = {});

/// Exact visibility of `light` (an area light counts as a point at its centre when `asPoint`, else the visible share of
/// its unoccluded irradiance). Undefined where the surface faces away from the light (by geometric or shading normal).
TruthImage visibilityTruth(const Scene& scene, const RayTracer& tracer, const Camera& camera, const Light& light,
                           const glm::ivec2& size, bool asPoint, const ProgressCallback& progress = {});

}  // namespace penumbra
