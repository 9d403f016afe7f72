// Solution 3: how much of the sky is seen, stored with the surface; no ray while drawing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_options.h"
#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/09_ambient_occlusion/visibility_bits.h"
#include "common/app/chapter.h"
#include "common/gl/gl_object.h"

namespace penumbra {

class BakedAmbient {
 public:
    explicit BakedAmbient(const Scene& scene) : scene_(scene) {}

    /// Bakes if what is stored was made with other parameters, and relights if another sky shines. Counts
    /// points, points_merged, points_skipped, rays_baked and bytes_stored of the bake, and rays_traced: those
    /// of this frame. Throws UsageError: what a method cannot do; Error: a file.
    void update(const Frame& frame, const AmbientOptions& options);

    /// Draws with the stored values as attributes 3 and 4.
    void draw(Program& program, const Frame& frame) const;

 private:
    void bake(const Frame& frame, const AmbientOptions& options);
    void bakeBitsOf(const Frame& frame, const AmbientOptions& options);
    void relightAll(const AmbientOptions& options);
    void upload(const Capabilities& capabilities);

    const Scene& scene_;
    std::optional<RayBundle> bundle_;
    std::string visibilityKey_, lightKey_;
    std::vector<AmbientValue> values_;  ///< of each vertex, or of each triangle
    std::vector<glm::vec3> light_;      ///< radiance that arrives, of the same
    std::optional<VisibilityBits> bits_;
    BakeWork work_;
    bool perTriangle_ = false;
    std::unique_ptr<Scene> unshared_;  ///< --method triangles: every triangle has its own three vertices
    std::unique_ptr<GpuScene> gpuUnshared_;
    GlBuffer attributes_;
};

/// The same triangles in the same order, none of which shares a vertex: what is constant on each can be drawn
/// from vertex attributes.
Scene withoutSharedVertices(const Scene& scene);

}  // namespace penumbra
