#include "chapters/08_accumulation/texel_target.h"

#include <fmt/format.h>

#include "common/error.h"

namespace penumbra {

namespace {

struct Transfer {
    GLenum format, type;
};

/// What OpenGL ES 3.0 pairs with each format.
Transfer transferOf(GLenum format) {
    switch (format) {
        case GL_R8:
            return {GL_RED, GL_UNSIGNED_BYTE};
        case GL_R32F:
            return {GL_RED, GL_FLOAT};
        case GL_RG32F:
            return {GL_RG, GL_FLOAT};
        case GL_RGBA8:
            return {GL_RGBA, GL_UNSIGNED_BYTE};
        case GL_R32UI:
            return {GL_RED_INTEGER, GL_UNSIGNED_INT};
        default:
            return {GL_RGBA, GL_FLOAT};
    }
}

void readTexelByTexel(GLenum target) {
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void attachDepth(const GlRenderbuffer& depth, const glm::ivec2& size) {
    glBindRenderbuffer(GL_RENDERBUFFER, depth.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size.x, size.y);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.id());
}

}  // namespace

std::vector<glm::vec4> readTexels(const glm::ivec2& size) {
    std::vector<glm::vec4> values(std::size_t(size.x) * std::size_t(size.y));
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, values.data());
    return values;
}

TexelTexture::TexelTexture(const glm::ivec2& size, GLenum format) : size_(size), format_(format) {
    const Transfer transfer = transferOf(format);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), size.x, size.y, 0, transfer.format, transfer.type, nullptr);
    readTexelByTexel(GL_TEXTURE_2D);
}

void TexelTexture::upload(const std::vector<float>& values) const {
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(format_), size_.x, size_.y, 0, transferOf(format_).format, GL_FLOAT,
                 values.data());
}

TexelTarget::TexelTarget(const glm::ivec2& size, GLenum format, bool withDepth)
    : color_(size, format), withDepth_(withDepth) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    if (withDepth) attachDepth(depth_, size);
    requireCompleteFramebuffer("a texture of light");
}

void TexelTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, size().x, size().y);
}

void TexelTarget::clear(const glm::vec4& value, float depth) const {
    bind();
    glClearBufferfv(GL_COLOR, 0, &value.x);
    if (!withDepth_) return;
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_DEPTH, 0, &depth);
}

std::vector<glm::vec4> TexelTarget::read() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    return readTexels(size());
}

PackedSums::PackedSums(const glm::ivec2& texels, GLenum format)
    : texels_(texels), seen_(fragments(), format), all_(fragments(), format) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, seen_.id(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, all_.id(), 0);
    attachDepth(depth_, fragments());
    const GLenum both[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, both);
    requireCompleteFramebuffer("sums of light");
}

void PackedSums::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, fragments().x, fragments().y);
}

void PackedSums::clear(float sum, float depth) const {
    bind();
    const glm::vec4 value(sum);
    glClearBufferfv(GL_COLOR, 0, &value.x);
    glClearBufferfv(GL_COLOR, 1, &value.x);
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_DEPTH, 0, &depth);
}

std::vector<glm::vec2> PackedSums::read() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    const std::vector<glm::vec4> seen = readTexels(fragments());
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    const std::vector<glm::vec4> all = readTexels(fragments());
    std::vector<glm::vec2> sums;
    for (int y = 0; y < texels_.y; ++y)
        for (int x = 0; x < texels_.x; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(fragments().x) + std::size_t(x / 4);
            sums.emplace_back(seen[i][x % 4], all[i][x % 4]);
        }
    return sums;
}

MaskLayers::MaskLayers(const glm::ivec2& size, int points, BitSetting setting)
    : size_(size), points_(points), layers_((points + pointsInLayer - 1) / pointsInLayer), setting_(setting) {
    const GLenum format = setting == BitSetting::logicOp ? GL_R32UI : GL_RGBA8;
    const Transfer transfer = transferOf(format);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.id());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GLint(format), size.x, size.y, layers_, 0, transfer.format,
                 transfer.type, nullptr);
    readTexelByTexel(GL_TEXTURE_2D_ARRAY);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture_.id(), 0, 0);
    if (setting == BitSetting::stencil) {
        glBindRenderbuffer(GL_RENDERBUFFER, stencil_.id());
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, size.x, size.y);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                  stencil_.id());
    }
    requireCompleteFramebuffer("a mask of light points");
}

void MaskLayers::bindCleared(int layer) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture_.id(), 0, layer);
    glViewport(0, 0, size_.x, size_.y);
    if (setting_ == BitSetting::logicOp) {
        const GLuint none[4] = {0, 0, 0, 0};
        glClearBufferuiv(GL_COLOR, 0, none);
    } else {
        const GLfloat none[4] = {0, 0, 0, 0};
        const GLint noPoint = 0;
        glClearBufferfv(GL_COLOR, 0, none);
        glClearBufferiv(GL_STENCIL, 0, &noPoint);
    }
}

}  // namespace penumbra
