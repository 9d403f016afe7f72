// The shadow map (Williams 1978): the depth of the surface nearest to the light, for each texel.
#pragma once

#include <cstdint>
#include <optional>

#include "chapters/01_depth_from_light/depth_format.h"
#include "chapters/01_depth_from_light/light_frustum.h"
#include "common/app/chapter.h"

namespace penumbra {

inline constexpr Skip keptMaps{"kept-maps", "shadow_maps_rendered",
                               "a shadow map that would come out the same is kept from the frame before "
                               "(a window, --still)"};
inline constexpr Skip clustersOffMap{"clusters-off-map", "triangles_submitted",
                                     "clusters of triangles that the light's frustum does not touch are not "
                                     "drawn into its map: every one of them would be clipped"};

/// How the casters are drawn into a map. Chapter 03 varies it; the defaults are the plain depth map.
struct CasterDraw {
    bool cullClosed = true;  ///< back faces of closed parts are left out: they are never nearest to the light
    bool frontFacesInstead = false;  ///< leave out front faces of closed parts instead
    float offsetFactor = 0.0f;       ///< glPolygonOffset; 0, 0: disabled
    float offsetUnits = 0.0f;
    bool operator==(const CasterDraw&) const = default;
};

class ShadowMap {
 public:
    /// `size` texels squared. Throws Error if the format cannot be rendered to.
    ShadowMap(int size, DepthFormat format);

    /// Makes the map hold the depths seen through `frustum`. Does nothing if it holds them already (same
    /// scene, frustum, program and way of drawing; keptMaps). Draws only the clusters that can touch the
    /// frustum (clustersOffMap), and never the light's own part. `program` sets gl_Position
    /// from uLightClipFromWorld and attribute 0. Counts shadow_maps_rendered, triangles_submitted,
    /// triangles_culled, draw_calls. Leaves frame.framebuffer bound.
    void render(Program& program, const Frame& frame, const Light& light, const LightFrustum& frustum,
                const CasterDraw& draw = {});
    /// Forgets what it holds: the next render draws.
    void invalidate() { held_.reset(); }

    GLuint texture() const { return texture_.id(); }
    GLuint framebuffer() const { return framebuffer_.id(); }
    int size() const { return size_; }
    DepthFormat format() const { return format_; }
    /// Another number for every drawing, of whichever map: what is derived from a map is made again when this
    /// changes.
    std::uint64_t revision() const { return revision_; }

 private:
    /// All that the content depends on. Scenes are immutable once loaded, so the pointer stands for the
    /// casters.
    struct Key {
        const GpuScene* scene;
        GLuint program;
        int lightPart;
        LightFrustum frustum;
        CasterDraw draw;
        bool operator==(const Key&) const = default;
    };

    int size_;
    DepthFormat format_;
    GlTexture texture_;
    GlFramebuffer framebuffer_;
    std::optional<Key> held_;
    std::uint64_t revision_ = 0;
};

}  // namespace penumbra
