// The sums, and the pass that adds to them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "chapters/06_jitter_texture/program_variants.h"
#include "chapters/08_accumulation/texel_target.h"
#include "chapters/10_accumulated_occlusion/receivers.h"
#include "chapters/10_accumulated_occlusion/sky_maps.h"
#include "common/app/skips.h"
#include "common/gl/fullscreen.h"

namespace penumbra {

/// Two RGBA32F textures that are drawn into together.
class TexturePair {
 public:
    explicit TexturePair(const glm::ivec2& size);
    void bind() const;
    void clear() const;
    GLuint first() const { return first_.id(); }
    GLuint second() const { return second_.id(); }
    const glm::ivec2& size() const { return first_.size(); }
    /// All texels of the first one, row 0 at the bottom.
    std::vector<glm::vec4> readFirst() const;

 private:
    TexelTexture first_, second_;
    GlFramebuffer framebuffer_;
};

inline constexpr Skip lookUpsFacingAway{"look-ups-facing-away", "",
                                        "a receiver that faces away from eight neighbouring directions "
                                        "looks none of them up: each counts 0"};

/// A batch of maps: layer i holds what `directions`[i] sees, and the sky there has `radiances`[i].
struct SkyBatch {
    std::span<const glm::dvec3> directions;
    std::span<const glm::dvec3> radiances;
    std::span<const LightFrustum> frusta;
    SkyBias bound;  ///< derived for all directions of the frame: it must not depend on who is in which batch
    bool skip = true;          ///< lookUpsFacingAway
    bool countWork = false;    ///< count look-ups in place of light
    float bias = 1.0f;         ///< multiple of the derived bound
    double cellTangent = 0.0;  ///< of what each direction stands for (sky_directions.h); 0: edges are hard
};

class VisibilitySums {
 public:
    /// Maps of one pass. OpenGL ES 3.0 promises 224 vectors of uniforms, and a map takes three: twice as many
    /// would fit, but take twice the memory and save next to no time.
    static constexpr int batch = 32;
    /// Neighbours among the directions of a batch that a receiver leaves out together. Fewer, and asking
    /// costs more than it saves; more, and their cone is too wide to be below many horizons.
    static constexpr std::size_t leaf = 8;

    VisibilitySums();
    /// Everything 0, for receivers of that size.
    void clear(const glm::ivec2& size);
    /// Adds the batch to the sums of all receivers: one full-screen pass.
    void add(const Receivers& receivers, const SkyMaps& maps, const SkyBatch& added);
    /// The means of all that was added, of `directions` directions. They lie where the next sums will: the
    /// next `add` overwrites them.
    const TexturePair& resolve(int directions);
    const TexturePair& resolved() const { return *sums_[1]; }
    std::vector<Program*> programs();

 private:
    ProgramVariants add_;
    Program resolve_;
    FullscreenTriangle triangle_;
    std::array<std::optional<TexturePair>, 2> sums_;  ///< [0]: the sums; [1]: the means, or the next sums
};

}  // namespace penumbra
