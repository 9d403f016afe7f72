// What each point sees of the sky, from whichever chapter knows how.
#pragma once

#include <optional>
#include <vector>

#include "chapters/09_ambient_occlusion/baked_ambient.h"
#include "chapters/09_ambient_occlusion/pixel_rays.h"
#include "chapters/10_accumulated_occlusion/accumulated_occlusion.h"
#include "chapters/11_bent_normals/bent_options.h"

namespace penumbra {

/// Ambient visibility A and bent vector B of each pixel or vertex.
class SeenSky {
 public:
    explicit SeenSky(const Scene& scene) : scene_(scene) {}
    /// Brings them up to date, by the counters of chapters 09 and 10.
    void update(const Frame& frame, const BentOptions& options);
    /// How many these are.
    std::int64_t points(const Frame& frame, const BentOptions& options) const;
    /// What 11_bent_normals/bent.vert and bent.frag are to be compiled with.
    std::vector<std::string> defines(const BentOptions& options) const;
    /// Draws the picture's surfaces with (B, A) as attribute 3 or as texture uSeen. After update.
    void draw(Program& program, const Frame& frame, const BentOptions& options) const;
    std::vector<Program*> programs();

 private:
    const Scene& scene_;
    std::optional<PixelRays> pixels_;  ///< each is made when it is first asked for
    std::optional<BakedAmbient> baked_;
    std::optional<AccumulatedOcclusion> maps_;
    GLuint texels_ = 0;  ///< one for each pixel
};

}  // namespace penumbra
