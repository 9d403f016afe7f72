// The parameters of a jittered filter, and what they make: chapters 06 and 07 share them.
#pragma once

#include <optional>

#include "chapters/04_pcf/compare_sampler.h"
#include "chapters/04_pcf/receiver_bias.h"
#include "chapters/06_jitter_texture/jitter_texture.h"

namespace penumbra {

class JitterOptions {
 public:
    float radius = 8.0f;
    int samples = 64;
    int tile = 16;
    std::string method = "texture", order = "blue", layout = "packed8";
    ReceiverBias bias{.receiverPlane = true};

    /// Declares --radius, --samples, --method, --tile, --order, --layout, --receiver-plane and --bias.
    void declare(Parameters& parameters);
    /// What shaders with jitter.glsl have to be compiled with. `view`: uView of shading.glsl. Throws
    /// UsageError: samples that make no pattern.
    std::vector<std::string> defines(int view) const;
    /// Sets all uniforms of jitter.glsl but those of setShadowMap. Makes pattern and sampler when they
    /// changed.
    void set(Program& program, const ShadowMap& map, const LightFrustum& frustum, const Frame& frame);
    /// Frees the GL objects: call it when a chapter loads.
    void reset();

 private:
    struct Key {
        int tile, samples;
        std::string order, layout;
        std::uint32_t seed;
        bool operator==(const Key&) const = default;
    };
    std::optional<Key> held_;
    std::optional<JitterTexture> texture_;
    std::optional<CompareSampler> compare_[2][2];  // reversed, bilinear
};

}  // namespace penumbra
