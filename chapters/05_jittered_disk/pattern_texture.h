// A pattern where shaders can read it.
#pragma once

#include <span>

#include <glm/glm.hpp>
#include "common/gl/gl_object.h"

namespace penumbra {

/// A texture of N x 1 texels, RG32F: texel i holds point i. For texelFetch.
class PatternTexture {
 public:
    explicit PatternTexture(std::span<const glm::dvec2> points);
    GLuint id() const { return texture_.id(); }

 private:
    GlTexture texture_;
};

}  // namespace penumbra
