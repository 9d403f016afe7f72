// What a depth map should hold: the depth of the first surface on the ray through each texel's centre.
#pragma once

#include "chapters/01_depth_from_light/depth_format.h"
#include "chapters/01_depth_from_light/light_frustum.h"
#include "common/truth/truth_image.h"

namespace penumbra {

/// Where the centre of each picture pixel falls on the map, as show_depth.frag draws it: the largest centred
/// square. (-1, -1) outside. Rows top first.
glm::ivec2 texelShownAt(const glm::ivec2& pixel, const glm::ivec2& pictureSize, int mapSize);

/// Exact window depth (or metres along the axis, if `linear`) of the centre of texel `texel`. `defined` is
/// false where a silhouette passes within the rasteriser's subpixel step of the centre, so that either side
/// is a right answer.
struct TexelDepth {
    double value = 1.0;
    bool defined = true;
    bool surface = false;  ///< false: nothing there, value is the far plane's
};
TexelDepth exactTexelDepth(const RayTracer& tracer, const LightFrustum& frustum, const glm::ivec2& texel,
                           int mapSize, DepthFormat format, int lightPart);

TruthImage depthTruth(const RayTracer& tracer, const LightFrustum& frustum, const glm::ivec2& pictureSize,
                      int mapSize, DepthFormat format, int lightPart, bool linear,
                      const ProgressCallback& progress);

}  // namespace penumbra
