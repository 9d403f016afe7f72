// The parameters of chapter 08, and what they make.
#pragma once

#include <string>
#include <vector>

#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/08_accumulation/light_points.h"
#include "chapters/08_accumulation/receiver.h"
#include "common/app/parameters.h"

namespace penumbra {

struct AccumulationOptions {
    int samples = 64, othersSamples = 16, texelBudget = 1024;
    float texelsPerMetre = 200.0f, minimumArea = 0.05f, intensity = 1.0f;
    std::string method = "mask", pattern = "owen-sobol", target = "32f", weights = "ratio", lightPart = "all",
                tint = "white", others = "shadow-maps", masks = "logic-op";

    ShadowOptions maps;  ///< of --method shadow-maps and --others; its light is --light, -1: all

    void declare(Parameters& parameters);

    /// Indices into Scene::lights: the chosen one, or all. Throws UsageError when the scene has fewer.
    std::vector<int> chosenLights(const Scene& scene) const;
    /// Light `index` with --light-part, --intensity and --tint applied: what the picture is lit by.
    Light lit(const Scene& scene, int index) const;
    std::vector<LightPoint> points(const Light& light, int count, std::uint32_t seed) const;
    ReceiverRequest receiverRequest(const Scene& scene) const;

    /// All that the shadows of a light depend on, and all that its light depends on besides.
    std::string shadowKey(std::uint32_t seed) const;
    std::string lightKey() const;
};

/// Does the part of the light that --light-part leaves on contain `p`? The halves are of the light's first
/// edge, through its centre.
bool inLightPart(const Light& light, const std::string& part, const glm::dvec3& p);

}  // namespace penumbra
