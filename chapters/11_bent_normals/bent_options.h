// The parameters of chapter 11.
#pragma once

#include <string>

#include "chapters/09_ambient_occlusion/ambient_options.h"
#include "chapters/10_accumulated_occlusion/occlusion_options.h"
#include "common/app/parameters.h"
#include "common/app/skips.h"
#include "common/scene/scene.h"

namespace penumbra {

inline constexpr Skip skyNotShown{"sky-not-shown", "points_asked",
                                  "no ray, bake or map of the sky for a picture of the lamp's light alone "
                                  "(--view diffuse, --combine none)"};

struct BentOptions {
    std::string source = "rays", weighting = "cosine", lookUp = "bent", irradiance = "map", sky = "overcast",
                combine = "principled", falloff = "hard";
    float range = 0.0f;
    int samples = 64, mapSize = 512, light = 0, truthRays = 2048;

    void declare(Parameters& parameters);
    /// Throws UsageError for combinations that mean nothing.
    void requireSense() const;
    /// Does this view show anything that A, B or the sky have a part in?
    bool asksTheSky(const std::string& view) const {
        return view != "diffuse" && (view != "color" || combine != "none");
    }
    /// Is the sky taken as a linear function of the direction?
    bool isLinear() const { return irradiance == "linear" || irradiance == "normalised"; }
    /// What A and B depend on, in the words of chapters 09 and 10: the sky is not part of it. The references
    /// last as long as this does.
    const AmbientOptions& ambient() const;
    const OcclusionOptions& occlusion() const;
    /// The sky, in the words of chapter 09.
    const AmbientOptions& shining() const;
    /// The sky, as bright as in chapter 09.
    const Sky& skyOf(const Scene& scene) const { return shining().light(scene).sky; }
    /// Throws UsageError when the scene has no such lamp.
    const Light& lamp(const Scene& scene) const;

 private:
    mutable AmbientOptions ambient_, shining_;  ///< the second remembers the sky it has read
    mutable OcclusionOptions occlusion_;
};

}  // namespace penumbra
