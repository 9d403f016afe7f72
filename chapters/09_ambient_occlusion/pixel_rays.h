// Solution 2: rays from what each pixel sees into its hemisphere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chapters/08_accumulation/texel_target.h"
#include "chapters/09_ambient_occlusion/ambient_options.h"
#include "chapters/09_ambient_occlusion/open_planes.h"
#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "common/app/chapter.h"

namespace penumbra {

inline constexpr Skip keptRays{"kept-rays", "rays_traced",
                               "what the pixels' rays found is kept from the frame before while nothing has "
                               "changed (a window, --still)"};

class PixelRays {
 public:
    explicit PixelRays(const Scene& scene) : tracer_(scene), planes_(scene) {}

    /// Traces, unless nothing has changed since the latest frame (keptRays). Counts primary_rays,
    /// rays_traced, rays_saved (towards what nothing can be in the way of) and pixels_receiving.
    ///
    /// `inParts`: for a window, where that would take seconds for each step of the mouse. One pixel of each
    /// block of 16 x 16 is traced at first, and every further frame refines for a tenth of a second; while
    /// anything is left it counts rows_left, and the window goes on drawing. The last picture is the same.
    void update(const Frame& frame, const AmbientOptions& options, bool inParts);
    /// The same, in parts if there is a window.
    void update(const Frame& frame, const AmbientOptions& options) {
        update(frame, options, frame.context->window() != nullptr);
    }

    /// One texel for each pixel. Bent vector and ambient visibility; radiance that arrives (E / pi), and how
    /// much work it was: 0 none, 1 rays that agreed, 2 rays that did not.
    GLuint values() const { return values_->id(); }
    GLuint light() const { return light_->id(); }

    /// What the pixels of the middle row see, and the ambient visibility of each pixel, top row first: of the
    /// latest update. Other rows are forgotten: what a ray found takes eight times what the picture does.
    const std::vector<Hit>& middleRow() const { return middleRow_; }
    float visibility(std::size_t pixel) const;

 private:
    struct Counts {
        std::int64_t traced = 0, saved = 0, receiving = 0;
    };

    void start(const Frame& frame, const std::string& key, bool inParts);
    void refine(const Frame& frame, const AmbientOptions& options, bool inParts);
    void traceRows(const Frame& frame, const AmbientOptions& options, int count, bool inParts);
    void traceRow(const Frame& frame, const AmbientOptions& options, const SkyLight& light, int y,
                  Counts& counts);
    void tracePixel(const Frame& frame, const AmbientOptions& options, const SkyLight& light,
                    const glm::ivec2& pixel, Counts& counts);
    int rows() const { return (size_.y + step_ - 1) / step_; }
    void upload(const glm::ivec2& size);
    /// Of pixel (x, y), y down, in the arrays below, whose rows run up as textures do.
    std::size_t texel(int x, int y) const { return std::size_t(size_.y - 1 - y) * size_.x + x; }

    RayTracer tracer_;
    OpenPlanes planes_;
    glm::ivec2 size_{0};
    std::optional<Camera> camera_;
    std::string key_;
    std::vector<Hit> middleRow_;
    std::vector<float> valueTexels_, lightTexels_;  ///< RGBA
    Counts counts_;
    int step_ = 0;  ///< side of the blocks that are being traced; 0: all is done
    int row_ = 0;   ///< the next row of them
    std::optional<TexelTexture> values_, light_;
};

/// Radiance (E / pi) that the sun sends to `hit` with the normal `normal`; 0 if something is in the way.
glm::dvec3 sunlight(const RayTracer& tracer, const Light& sun, const Hit& hit, const glm::dvec3& normal);

}  // namespace penumbra
