// Reads a shadow map through a comparison instead of as numbers.
#pragma once

#include "chapters/01_depth_from_light/shadow_map.h"

namespace penumbra {

/// GL_LINEAR: 2x2 comparisons, blended by the sampler; GL_NEAREST: one. One for each depth range; the map's
/// own state is left alone.
class CompareSampler {
 public:
    explicit CompareSampler(DepthRange range, GLenum filter = GL_LINEAR);
    GLuint id() const { return sampler_.id(); }

 private:
    GlSampler sampler_;
};

}  // namespace penumbra
