// The irradiance of a sky on the GPU, in the form that is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chapters/08_accumulation/texel_target.h"
#include "chapters/11_bent_normals/bent_options.h"
#include "chapters/11_bent_normals/irradiance_map.h"
#include "chapters/11_bent_normals/sh_irradiance.h"
#include "common/gl/program.h"

namespace penumbra {

class SkyIrradiance {
 public:
    /// Computes what is needed for options.sky and options.irradiance and is not there already. Returns the
    /// rows of the irradiance map, 0 without one.
    int update(const Scene& scene, const BentOptions& options);
    /// What 11_bent_normals/irradiance.glsl is to be compiled with.
    std::vector<std::string> defines(const BentOptions& options) const;
    /// Sets its uniforms.
    void set(Program& program, const BentOptions& options) const;

 private:
    std::string sky_;                    ///< whose numbers these are
    std::optional<SkySamples> samples_;  ///< until a map has been made of them
    ShIrradiance harmonics_;
    LinearSky linear_;
    std::optional<TexelTexture> map_;
};

}  // namespace penumbra
