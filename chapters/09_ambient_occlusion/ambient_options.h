// The parameters of chapter 09, and what they make.
#pragma once

#include <optional>
#include <string>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "chapters/09_ambient_occlusion/sky.h"
#include "common/app/parameters.h"
#include "common/scene/scene.h"

namespace penumbra {

/// What shines: a sky, and perhaps the scene's sun. Radiance is in the scene's units: the sky `uniform` is
/// what maps to white (exposure in common/scene/light.h), so that a picture of any scene is well exposed.
struct SkyLight {
    Sky sky;
    glm::dvec3 onOpenGround{0.0};  ///< of the sky alone: all that a stored number knows about it
    std::optional<Light> sun;
};

/// The parameters --range and --falloff, of every chapter whose rays may end.
void declareReach(Parameters& parameters, float& range, std::string& falloff);
/// The parameter --sky, for Sky::named: of every chapter that has one.
void declareSky(Parameters& parameters, std::string& sky);
/// The skips of rays and bakes, and of drawing their picture.
void declareAmbientSkips(Parameters& parameters);

struct AmbientOptions {
    int samples = 64, truthRays = 4096;
    float range = 0.0f;
    bool sun = false, share = true;
    bool atEdges = false;  ///< of --method rays: half of them where it matters (edge_rays.h); for chapter 11
    std::string method = "rays", weighting = "cosine", falloff = "hard", sky = "uniform", skyPart = "all",
                values = "points", save = "none";

    void declare(Parameters& parameters);

    /// --samples, --weighting, --range and --falloff.
    AmbientRays rays() const;
    /// --sky, --sky-part and --sun. Throws UsageError: no such sky, or no sun in the scene; Error: a broken
    /// file.
    const SkyLight& light(const Scene& scene) const;

    bool isBaked() const { return method != "hemisphere" && method != "rays"; }
    /// All that visibility depends on, and all that light depends on besides.
    std::string visibilityKey(std::uint32_t seed) const;
    std::string lightKey() const;

 private:
    mutable std::optional<SkyLight> light_;  ///< a sky may be a file: read once
    mutable std::string madeOf_;
};

}  // namespace penumbra
