// Ambient visibility and bent vectors from N shadow maps, added up.
#pragma once

#include <memory>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "chapters/09_ambient_occlusion/sky.h"
#include "chapters/10_accumulated_occlusion/occlusion_options.h"
#include "common/app/chapter.h"

namespace penumbra {

/// The result, on the GPU: a texel for each pixel of the frame, or for each vertex of the scene.
struct AmbientTextures {
    /// RGBA32F. w: ambient visibility A, 0 to 1; xyz: bent vector, not normalised (open: 2/3 n). All 0 where
    /// there is no surface, or no direction above the horizon. Cosine weighting: AmbientValue of chapter 09.
    GLuint ambient = 0;
    /// RGBA32F. xyz: light that arrives, E / pi, under the sky asked for; w: in the view "work", the share of
    /// the directions that were looked up (xyz then are counts).
    GLuint light = 0;
    glm::ivec2 size{0};
    /// Texel (i % size.x, i / size.x) is vertex i (gl_VertexID); false: texel of pixel gl_FragCoord.
    bool perVertex = false;
};

inline constexpr Skip keptOcclusion{"kept-occlusion", "shadow_maps_rendered",
                                    "sums to which nothing is to be added are kept from the frame before (a "
                                    "window, --still)"};
inline constexpr Skip mapsBelowHorizon{"maps-below-horizon", "shadow_maps_rendered",
                                       "no map from a direction that is below the horizon of every receiver: "
                                       "it counts 0"};

class AccumulatedOcclusion {
 public:
    AccumulatedOcclusion();
    ~AccumulatedOcclusion();
    AccumulatedOcclusion(AccumulatedOcclusion&&) noexcept;
    AccumulatedOcclusion& operator=(AccumulatedOcclusion&&) noexcept;

    /// Brings the textures up to date for this frame: valid until the next call. Does nothing if they are up
    /// to date already (keptOcclusion; and maps need not be drawn again); with `options.rotate` adds
    /// another `options.samples` directions as long as nothing else changes, up to 16384
    /// (directions_left says how many more; the window goes on drawing). A(x) = sum V max(0, n.l) / sum
    /// max(0, n.l) over all directions so far. Counts directions_added, shadow_maps_rendered,
    /// shadow_maps_skipped, triangles_submitted, draw_calls. Leaves frame.framebuffer bound, with its
    /// viewport, and the depth test off. Throws Error where floats cannot be drawn into.
    AmbientTextures update(const Frame& frame, const OcclusionOptions& options, const Sky& sky);

    /// values[i] of vertex i, read back. The latest update must have been per vertex.
    std::vector<AmbientValue> vertexValues(const Scene& scene) const;

    std::vector<Program*> programs();

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra
