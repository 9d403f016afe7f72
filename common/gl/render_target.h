// A picture to render into, and the way back to the CPU.
#pragma once

#include <glm/glm.hpp>

#include "common/gl/context.h"
#include "common/gl/gl_object.h"
#include "common/image/image.h"

namespace penumbra {

/// A colour texture of linear values, with a 32-bit float depth buffer.
class RenderTarget {
 public:
    /// Colour is GL_RGBA32F where that can be rendered to, else GL_RGBA16F, else GL_RGBA8 (values then clamp
    /// to 0..1). `colorFormat` asks for one of them. Throws Error: size not positive or too large, format not
    /// renderable.
    RenderTarget(const glm::ivec2& size, const Capabilities& capabilities, GLenum colorFormat = 0);

    GLuint framebuffer() const { return framebuffer_.id(); }
    GLuint colorTexture() const { return color_.id(); }
    GLenum colorFormat() const { return format_; }
    const glm::ivec2& size() const { return size_; }
    /// Makes it the target of drawing and sets the viewport.
    void bind() const;
    /// `channels` 1 to 4, the first ones; top row first. Waits for the drawing to finish.
    FloatImage read(int channels) const;

 private:
    bool attach(GLenum colorFormat);

    glm::ivec2 size_;
    GLenum format_ = 0;
    GlTexture color_;
    GlRenderbuffer depth_;
    GlFramebuffer framebuffer_;
};

/// The values of a depth texture, in [0,1], exactly as stored; 1 channel, TOP row first. `texture` must be
/// GL_TEXTURE_2D of that size. Works on ES too. Leaves framebuffer, viewport and program changed, and the
/// texture's comparison off.
FloatImage readDepthTexture(GLuint texture, const glm::ivec2& size);

}  // namespace penumbra
