// Shadow maps of the sky: the scene from many directions at infinity, each a layer of one texture.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "chapters/01_depth_from_light/depth_format.h"
#include "chapters/01_depth_from_light/light_frustum.h"
#include "common/app/chapter.h"

namespace penumbra {

struct BoundingSphere {
    glm::dvec3 centre{0.0};
    double radius = 0.0;  ///< metres, above 0
};

/// About the centre of the scene's box, to its farthest vertex.
BoundingSphere boundingSphere(const Scene& scene);

/// What is seen from infinity in the direction `toSky` (unit): a box around the sphere, so that nothing is
/// ever cut off, and texels are equally large in all maps.
LightFrustum skyFrustum(const BoundingSphere& sphere, const glm::dvec3& toSky);

/// The bound of chapter 03 (bias.glsl) when no map has perspective: B = perSlope * (|dz/ds| + |dz/dt|) +
/// constant, window depth, for all of `frusta` and every depth in [0,1]. Needs a context.
struct SkyBias {
    float perSlope = 0.0f;
    float constant = 0.0f;
};
SkyBias skyBias(DepthFormat format, std::span<const LightFrustum> frusta, const Aabb& bounds, int mapSize);

class SkyMaps {
 public:
    /// Throws Error if the format cannot be rendered to.
    SkyMaps(int mapSize, DepthFormat format, int layers);
    /// As many layers of `mapSize` texels squared as 128 MB hold: 1 to `most`.
    static int layersFor(int mapSize, int most);

    int layers() const { return int(framebuffers_.size()); }
    int mapSize() const { return mapSize_; }
    DepthFormat format() const { return format_; }
    GLuint texture() const { return texture_.id(); }

    /// Draws the scene into layer i as `frusta`[i] sees it, for each of at most layers(). Counts
    /// shadow_maps_rendered, triangles_submitted, draw_calls. Leaves framebuffer and viewport changed.
    void render(Program& program, const Frame& frame, std::span<const LightFrustum> frusta);

 private:
    int mapSize_;
    DepthFormat format_;
    GlTexture texture_;
    std::vector<GlFramebuffer> framebuffers_;
};

}  // namespace penumbra
