#include "common/gl/render_target.h"

#include <fmt/format.h>

#include <algorithm>
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

struct PixelFormat {
    GLenum format, type;
};

/// What the bound framebuffer holds; OpenGL's bottom row comes first, ours last. Some rows at a time: the
/// four channels of a large picture would take more memory than the picture itself.
template <class Value, class Convert>
FloatImage readFlipped(const glm::ivec2& size, int channels, PixelFormat pixel, Convert convert) {
    constexpr int pixelsAtOnce = 1 << 18;
    const int band = std::clamp(pixelsAtOnce / size.x, 1, size.y);
    std::vector<Value> rgba(std::size_t(band) * size.x * 4);
    FloatImage image(size.x, size.y, channels);
    for (int low = 0; low < size.y; low += band) {
        const int rows = std::min(band, size.y - low);
        glReadPixels(0, low, size.x, rows, pixel.format, pixel.type, rgba.data());
        for (int row = 0; row < rows; ++row)
            for (int x = 0; x < size.x; ++x)
                for (int c = 0; c < channels; ++c)
                    image.at(x, size.y - 1 - low - row, c) =
                        convert(rgba[(std::size_t(row) * size.x + x) * 4 + c]);
    }
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
    if (format_ == GL_RGBA8)
        return readFlipped<GLubyte>(size_, channels, {GL_RGBA, GL_UNSIGNED_BYTE},
                                    [](GLubyte value) { return float(value) / 255.0f; });
    return readFlipped<float>(size_, channels, {GL_RGBA, GL_FLOAT}, [](float value) { return value; });
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
    return readFlipped<GLuint>(size, 1, {GL_RGBA_INTEGER, GL_UNSIGNED_INT}, floatFromBits);
}

}  // namespace penumbra
