// OpenGL objects as move-only values that free what they own. The raw id stays readable:
// `glBindTexture(GL_TEXTURE_2D, map.id())` is still plain OpenGL.
#pragma once

#include <utility>

#include "common/gl/gl.h"

namespace penumbra {

/// `Traits` supplies `static GLuint create()` and `static void destroy(GLuint)`.
template <class Traits>
class GlObject {
 public:
    GlObject() : id_(Traits::create()) {}
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    GlObject(const GlObject&) = delete;
    GlObject& operator=(const GlObject&) = delete;
    ~GlObject() {
        if (id_ != 0) Traits::destroy(id_);
    }
    GLuint id() const { return id_; }

 private:
    GLuint id_;
};

struct TextureTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct BufferTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct VertexArrayTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct FramebufferTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct SamplerTraits {
    static GLuint create();
    static void destroy(GLuint id);
};
struct RenderbufferTraits {
    static GLuint create();
    static void destroy(GLuint id);
};

using GlTexture = GlObject<TextureTraits>;
using GlBuffer = GlObject<BufferTraits>;
using GlVertexArray = GlObject<VertexArrayTraits>;
using GlFramebuffer = GlObject<FramebufferTraits>;
using GlSampler = GlObject<SamplerTraits>;
using GlRenderbuffer = GlObject<RenderbufferTraits>;

/// Throws Error naming `what` unless the bound GL_FRAMEBUFFER is complete.
void requireCompleteFramebuffer(const char* what);
/// Throws Error with the pending GL error or the last KHR_debug message of type error, if any.
void checkGlErrors(const char* where);
/// Forgets pending errors: after a library that tries calls which OpenGL ES does not have.
void discardGlErrors();

}  // namespace penumbra
