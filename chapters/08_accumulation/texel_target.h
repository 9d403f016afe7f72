// Textures that are drawn into, one value per texel of a receiver (or pixel of the picture).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "common/gl/gl_object.h"

namespace penumbra {

/// A texture of `format`, read texel by texel.
class TexelTexture {
 public:
    TexelTexture(const glm::ivec2& size, GLenum format);
    /// Fills it from the CPU: as many floats a texel as the format has channels, row 0 at the bottom.
    void upload(const std::vector<float>& values) const;
    GLuint id() const { return texture_.id(); }
    const glm::ivec2& size() const { return size_; }
    GLenum format() const { return format_; }

 private:
    glm::ivec2 size_;
    GLenum format_;
    GlTexture texture_;
};

/// RGBA of the bound framebuffer's colour attachment that is read from, row 0 at the bottom.
std::vector<glm::vec4> readTexels(const glm::ivec2& size);

/// One that is drawn into, with its framebuffer. Throws Error if the format cannot be rendered to. Making one
/// leaves it bound.
class TexelTarget {
 public:
    TexelTarget(const glm::ivec2& size, GLenum format, bool withDepth = false);
    /// Makes it the target of drawing, and the viewport its size.
    void bind() const;
    void clear(const glm::vec4& value, float depth = 1.0f) const;
    void upload(const std::vector<float>& values) const { color_.upload(values); }
    /// All texels as RGBA, row 0 at the bottom. Waits for the drawing to finish.
    std::vector<glm::vec4> read() const;
    GLuint texture() const { return color_.id(); }
    const glm::ivec2& size() const { return color_.size(); }
    GLenum format() const { return color_.format(); }

 private:
    TexelTexture color_;
    bool withDepth_;
    GlRenderbuffer depth_;
    GlFramebuffer framebuffer_;
};

/// The sums of --method mask: four texels of a row in one of each texture, with a depth that says which of
/// them are mixed.
class PackedSums {
 public:
    PackedSums(const glm::ivec2& texels, GLenum format);
    void bind() const;
    void clear(float sum, float depth) const;
    GLuint seen() const { return seen_.id(); }  ///< of visible weights
    GLuint all() const { return all_.id(); }    ///< of all weights
    const glm::ivec2& texels() const { return texels_; }
    glm::ivec2 fragments() const { return {(texels_.x + 3) / 4, texels_.y}; }
    /// (seen, all) of each texel, row 0 at the bottom. Waits for the drawing to finish.
    std::vector<glm::vec2> read() const;

 private:
    glm::ivec2 texels_;
    TexelTexture seen_, all_;
    GlRenderbuffer depth_;
    GlFramebuffer framebuffer_;
};

/// How bits get into a mask.
enum class BitSetting {
    logicOp,  ///< R32UI, GL_OR: 32 light points in one draw call
    stencil   ///< RGBA8, a draw call per point: the stencil lets each bit be added once; nothing but ES 3.0
};

/// The stored visibility of a receiver: a bit for each texel and light point, 32 points in a layer; set:
/// hidden.
class MaskLayers {
 public:
    static constexpr int pointsInLayer = 32;

    MaskLayers(const glm::ivec2& size, int points, BitSetting setting);
    /// Makes `layer` the target of drawing, all of its bits clear.
    void bindCleared(int layer) const;
    GLuint texture() const { return texture_.id(); }
    int layers() const { return layers_; }
    int points() const { return points_; }
    BitSetting setting() const { return setting_; }
    const glm::ivec2& size() const { return size_; }

 private:
    glm::ivec2 size_;
    int points_, layers_;
    BitSetting setting_;
    GlTexture texture_;
    GlRenderbuffer stencil_;
    GlFramebuffer framebuffer_;
};

}  // namespace penumbra
