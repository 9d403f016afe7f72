// The nearest and the farthest depth around every point of a shadow map, so that one look-up says lit, dark
// or mixed for a whole kernel.
#pragma once

#include <array>
#include <optional>

#include "chapters/01_depth_from_light/shadow_map.h"
#include "chapters/06_jitter_texture/program_variants.h"
#include "common/gl/fullscreen.h"

namespace penumbra {

inline constexpr Skip keptMinMax{"kept-min-max", "min_max_maps_built",
                                 "minima and maxima of a map that has not changed are kept from the frame "
                                 "before"};

/// Blocks of 8 x 8 texels, dilated by the kernel's reach: texel i stands for the blocks from i - before() on,
/// `window()` of them in each direction. A minimum, of depth measured from one of three planes, that plane,
/// and a maximum.
///
/// Guennebaud, Barthe & Paulin (2006, EGSR) and Decoret (2005, "N-buffers", Eurographics) keep minima and
/// maxima for kernels of all sizes; for one size a window of that size is tighter and takes one look-up.
class MinMaxMap {
 public:
    static constexpr int block = 8;  ///< texels along a side; the shaders know it too

    /// `gather`: read four texels in one look-up, where the context can.
    explicit MinMaxMap(bool gather);

    /// Makes it that of `map`, for kernels that read texels up to `reach` away. `slopes`: of the three
    /// planes, over the whole map, oriented. Does nothing if it is already (keptMinMax); counts
    /// min_max_maps_built. Leaves frame.framebuffer bound.
    void build(const ShadowMap& map, DepthRange range, const std::array<glm::vec2, 3>& slopes, float reach,
               const Frame& frame);
    /// Sets the uniforms of classify.glsl.
    void set(Program& program) const;

    GLuint texture() const { return dilated_.texture.id(); }
    const glm::ivec2& size() const { return dilated_.size; }
    int window() const { return window_; }
    int before() const { return before_; }
    std::vector<Program*> programs();

 private:
    struct Target {
        glm::ivec2 size{0};
        GlTexture texture;
        GlFramebuffer framebuffer;
        void provide(const glm::ivec2& wanted);
        void bind() const;
    };
    struct Key {
        std::uint64_t revision;
        std::array<glm::vec2, 3> slopes;
        float reach;
        bool operator==(const Key&) const = default;
    };
    void reduceToBlocks(const ShadowMap& map, DepthRange range);
    void dilate(const Target& from, const Target& to, bool alongT, int mapSize);
    void setSlopes(Program& program) const;

    bool gather_;
    ProgramVariants blocks_, dilate_;
    FullscreenTriangle triangle_;
    Target blockwise_, along_, dilated_;
    std::optional<Key> held_;
    int window_ = 0, before_ = 0;
    glm::vec2 texelFromSt_{0.0f};  ///< factor and offset
};

}  // namespace penumbra
