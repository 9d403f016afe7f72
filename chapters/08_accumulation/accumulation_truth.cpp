#include "chapters/08_accumulation/accumulation_truth.h"

#include <numbers>

#include "chapters/00_ray_traced_truth/blinn_phong.h"
#include "chapters/01_depth_from_light/shadow_options.h"
#include "common/error.h"
#include "common/scene/light.h"
#include "common/truth/truth_image.h"

namespace penumbra {

namespace {

/// Emission, ambient term and the diffuse reflection of `irradiance`, in place.
void reflect(TruthImage& irradiance, const TruthRequest& request, const AccumulationOptions& options) {
    const glm::dvec3 ambient(ambientRadiance(request.scene, options.maps.light, ambientShare));
    const PrimaryHits primary = primaryHits(request.tracer, request.camera, request.size);
    const auto answer = [&](const Hit& hit, int x, int y, float* value) {
        const Surface surface = surfaceAt(request.scene, hit);
        for (int c = 0; c < 3; ++c)
            value[c] = float(surface.emission[c] +
                             surface.diffuse[c] *
                                 (ambient[c] + double(irradiance.value.at(x, y, c)) / std::numbers::pi));
        return true;
    };
    irradiance.value = surfaceTruth(primary, 3, answer).value;
    irradiance.quantity = "radiance";
}

}  // namespace

TruthImage accumulationTruth(const TruthRequest& request, const AccumulationOptions& options) {
    std::vector<Light> lights;
    for (const int index : options.chosenLights(request.scene))
        lights.push_back(options.lit(request.scene, index));
    if (request.view == "visibility")
        return visibilityTruth(request.scene, request.tracer, request.camera, lights[0], request.size, false,
                               request.progress);
    if (request.view != "irradiance" && request.view != "color")
        throw UsageError(
            "--compare-truth: chapter 08 has exact answers for --view color, visibility and irradiance");
    TruthImage truth = irradianceTruth(request.scene, request.tracer, request.camera, lights, request.size,
                                       false, request.progress);
    if (request.view == "color") reflect(truth, request, options);
    return truth;
}

}  // namespace penumbra
