#include "common/gl/render_target.h"

#include <fmt/format.h>

#include <cstring>
#include <vector>

#include "common/error.h"
#include "common/gl/fullscreen.h"
#include "common/gl/program.h"

namespace penumbra {
namespace {

void requireSize(const glm::ivec2& size) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (size.x < 1 || size.y < 1 || size.x > limit || size.y > limit)
        throw Error(
            fmt::format("a picture of {}x{} pixels cannot be rendered; this driver allows 1 to {} on a side",
                        size.x, size.y, limit));
}

void nearestFilter() {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// OpenGL's bottom row comes first, ours last.
template <class Value, class Convert>
FloatImage flipped(const std::vector<Value>& rgba, const glm::ivec2& size, int channels, Convert convert) {
    FloatImage image(size.x, size.y, channels);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < channels; ++c)
                image.at(x, y, c) = convert(rgba[(std::size_t(size.y - 1 - y) * size.x + x) * 4 + c]);
    return image;
}

float floatFromBits(GLuint bits) {
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
}

}  // namespace

RenderTarget::RenderTarget(const glm::ivec2& size, const Capabilities& capabilities, GLenum colorFormat)
    : size_(size) {
    requireSize(size);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size.x, size.y);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    if (colorFormat != 0) {
        attach(colorFormat);
    } else if (!(capabilities.floatColorBuffer && attach(GL_RGBA32F)) && !attach(GL_RGBA16F)) {
        attach(GL_RGBA8);
    }
    requireCompleteFramebuffer("a colour picture");
}

bool RenderTarget::attach(GLenum colorFormat) {
    format_ = colorFormat;
    const GLenum type = colorFormat == GL_RGBA8 ? GL_UNSIGNED_BYTE : GL_FLOAT;
    glBindTexture(GL_TEXTURE_2D, color_.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(colorFormat), size_.x, size_.y, 0, GL_RGBA, type, nullptr);
    nearestFilter();
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void RenderTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, size_.x, size_.y);
}

FloatImage RenderTarget::read(int channels) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    const std::size_t count = std::size_t(size_.x) * size_.y * 4;
    if (format_ == GL_RGBA8) {
        std::vector<GLubyte> bytes(count);
        glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        return flipped(bytes, size_, channels, [](GLubyte value) { return float(value) / 255.0f; });
    }
    std::vector<float> floats(count);
    glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, floats.data());
    return flipped(floats, size_, channels, [](float value) { return value; });
}

FloatImage readDepthTexture(GLuint texture, const glm::ivec2& size) {
    requireSize(size);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_NONE);
    const GlTexture bits;
    glBindTexture(GL_TEXTURE_2D, bits.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, size.x, size.y, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
    nearestFilter();
    const GlFramebuffer framebuffer;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, bits.id(), 0);
    requireCompleteFramebuffer("an integer picture");
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST);
    Program program("common/fullscreen.vert", "common/read_depth.frag");
    program.setTexture("uDepth", GL_TEXTURE_2D, texture);
    program.prepareToDraw();
    FullscreenTriangle().draw();
    std::vector<GLuint> values(std::size_t(size.x) * size.y * 4);
    glReadPixels(0, 0, size.x, size.y, GL_RGBA_INTEGER, GL_UNSIGNED_INT, values.data());
    return flipped(values, size, 1, floatFromBits);
}

}  // namespace penumbra
