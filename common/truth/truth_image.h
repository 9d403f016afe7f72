// Exact answers for whole pictures: what `--compare-truth` compares with. All of them run on all cores, give
// the same picture for any number of threads, and are found again on disk when nothing they depend on has
// changed (truth_cache.h).
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/scene/scene.h"
#include "common/truth/parallel.h"
#include "common/truth/ray_tracer.h"

namespace penumbra {

struct TruthImage {
    FloatImage value;            ///< exact values, 1 or 3 channels
    FloatImage mask;             ///< 1 channel: 1 where the answer is defined, else 0
    std::string quantity;        ///< "visibility", "depth", "irradiance"
    std::string method;          ///< "closed form", "ray traced", or "closed form; ray traced in N pixels"
    std::string against;         ///< "point light", "area light", "all lights", "filter"
    std::size_t background = 0;  ///< pixels left out: no surface
    std::size_t facingAway = 0;  ///< ... : n.l <= 0, or outside a spot's cone, or behind an area light
    std::size_t straddling =
        0;  ///< ... : the camera's pixel straddles a silhouette (its corners see other surfaces)
};

/// What the camera sees at each pixel's centre, top row first. `straddling[i]`: the pixel's corners do not
/// all see the same part at about the same depth and normal, so its value is undefined. The normals of
/// double-sided materials are flipped towards the camera, see Material.
struct PrimaryHits {
    glm::ivec2 size{0};
    std::vector<Hit> hits;
    std::vector<std::uint8_t> straddling;
};
PrimaryHits primaryHits(const RayTracer& tracer, const Camera& camera, const glm::ivec2& size,
                        const ProgressCallback& progress = {});

/// Flips both normals if the eye that sent `ray` sees the back of the face.
void faceTheEye(Hit& hit, const Ray& ray);

/// Writes the exact value(s) at pixel (x, y), which sees `hit`; false: undefined there (facing away).
using SurfaceAnswer = std::function<bool(const Hit& hit, int x, int y, float* value)>;
/// Asks `answer` for every pixel that has a surface and straddles no silhouette, on all cores. quantity,
/// method and against are left to the caller.
TruthImage surfaceTruth(const PrimaryHits& primary, int channels, const SurfaceAnswer& answer,
                        const ProgressCallback& progress = {});

/// Exact visibility of `light` (an area light counts as a point at its centre when `asPoint`, else the
/// visible share of its unoccluded irradiance). Undefined where the surface faces away from the light (by
/// geometric or shading normal). Computed in double from the scene's triangles: segments for points, cone
/// subtraction for areas; see LightVisibility for the few pixels where that is impractical.
TruthImage visibilityTruth(const Scene& scene, const RayTracer& tracer, const Camera& camera,
                           const Light& light, const glm::ivec2& size, bool asPoint,
                           const ProgressCallback& progress = {});

/// Exact irradiance of all `lights` together by the shading normal, 3 channels, W/m^2; 0 where a light is
/// faced away from. Undefined only in the background and on silhouettes.
TruthImage irradianceTruth(const Scene& scene, const RayTracer& tracer, const Camera& camera,
                           std::span<const Light> lights, const glm::ivec2& size, bool asPoint,
                           const ProgressCallback& progress = {});

}  // namespace penumbra
