// Chapter 00: the picture that all others are measured against.
//
// For each pixel a ray into the scene, for each light a shadow ray from what it hit. There is no shadow map,
// no bias and no filter, and nothing to go wrong but the number of samples of an area light.
#include <atomic>
#include <optional>

#include "chapters/00_ray_traced_truth/blinn_phong.h"
#include "chapters/00_ray_traced_truth/shadow_rays.h"
#include "common/app/chapter.h"
#include "common/error.h"
#include "common/math/sampling.h"
#include "common/scene/light.h"

using namespace penumbra;

namespace {

class RayTracedTruth : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        parameters.add("samples", samples_, 1, 4096, "",
                       "points of an area light; 1: grainy penumbrae, 1024: smooth and slow");
        parameters.add("light", light_, -1, 63, "",
                       "index of the light; -1: all of them (visibility: the first)");
        parameters.add("ambient", ambient_, 0.0f, 1.0f, "",
                       "ambient light, as a share of the key light; 0: black shadows");
        parameters.add("adaptive", options_.adaptive,
                       "ask for the other samples only where the first 16 disagree");
        parameters.add(
            "start", options_.start, {"exact", "rounded"},
            "where shadow rays start; rounded: at the hit rounded to float, and surfaces shadow themselves");
        parameters.skips().declare(raysFacingAway);
    }

    void load(const Scene& scene, const Context*) override { tracer_.emplace(scene); }

    // [begin:loop]
    void render(const Frame& frame) override {
        const std::vector<const Light*> lights = chosenLights(frame.scene, frame.view);
        const bool scalar = frame.view == "visibility" || frame.view == "rays";
        // Where nothing is hit the ambient term is seen itself: a uniform sky, of this radiance.
        const glm::vec3 ambient = ambientRadiance(frame.scene, light_, ambient_);
        const float background = frame.view == "color" ? ambient.r : 0.0f;
        *frame.cpuPicture = FloatImage(frame.size.x, frame.size.y, scalar ? 1 : 3, background);
        std::atomic<std::int64_t> receiving = 0, traced = 0, facingAway = 0, agreed = 0;

        parallelRows(
            frame.size.y,
            [&](int y) {
                RayCounts counts;
                for (int x = 0; x < frame.size.x; ++x) {
                    const Ray ray = cameraRay(frame.camera, {x + 0.5, y + 0.5}, frame.size);
                    Hit hit = tracer_->nearest(ray);
                    if (!hit.valid) continue;
                    faceTheEye(hit, ray);
                    const glm::dvec3 value =
                        pixel(frame, lights, ray, hit, hashSeed(x, y, frame.seed), counts);
                    for (int c = 0; c < frame.cpuPicture->channels; ++c)
                        frame.cpuPicture->at(x, y, c) = float(value[c]);
                    ++receiving;
                }
                traced += counts.traced;
                facingAway += counts.savedFacingAway;
                agreed += counts.savedByAgreement;
            },
            frame.progress);

        frame.work["primary_rays"] = std::int64_t(frame.size.x) * frame.size.y;
        frame.work["pixels_receiving"] = receiving;
        frame.work["shadow_rays"] = traced;
        frame.work["rays_saved_facing_away"] = facingAway;
        frame.work["rays_saved_by_agreement"] = agreed;
    }
    // [end:loop]

    TruthImage truth(const TruthRequest& request) override {
        std::vector<Light> lights;
        for (const Light* light : chosenLights(request.scene, request.view)) lights.push_back(*light);
        if (request.view == "visibility")
            return visibilityTruth(request.scene, request.tracer, request.camera, lights[0], request.size,
                                   false, request.progress);
        if (request.view == "irradiance")
            return irradianceTruth(request.scene, request.tracer, request.camera, lights, request.size, false,
                                   request.progress);
        throw UsageError(
            "--compare-truth: chapter 00 has exact answers for --view visibility and --view irradiance");
    }

 private:
    // [begin:pixel]
    glm::dvec3 pixel(const Frame& frame, const std::vector<const Light*>& lights, const Ray& ray,
                     const Hit& hit, std::uint32_t seed, RayCounts& counts) const {
        const Surface surface = surfaceAt(frame.scene, hit);
        const glm::dvec3 toEye = -glm::normalize(ray.direction);
        ShadowRayOptions options = options_;
        options.skip = frame.skips(raysFacingAway);
        const std::int64_t before = counts.traced;

        glm::dvec3 radiance =
            surface.emission + surface.diffuse * glm::dvec3(ambientRadiance(frame.scene, light_, ambient_));
        glm::dvec3 irradiance(0.0), unoccluded(0.0);
        for (std::size_t k = 0; k < lights.size(); ++k) {
            const auto samples = sampleLight(*lights[k], hit, samples_, hashSeed(seed, std::uint32_t(k)));
            std::vector<std::uint8_t> seen(samples.size());
            castShadowRays(*tracer_, hit, *lights[k], samples, options, seen, counts);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const double S = seen[i];
                const glm::dvec3 arriving =
                    samples[i].facingIrradiance * std::max(0.0, glm::dot(surface.normal, samples[i].toLight));
                unoccluded += arriving;
                irradiance += S * arriving;
                radiance += S * samples[i].facingIrradiance * blinnPhong(surface, samples[i].toLight, toEye);
            }
        }
        if (frame.view == "irradiance") return irradiance;
        if (frame.view == "rays") return glm::dvec3(double(counts.traced - before));
        const double sum = unoccluded.r + unoccluded.g + unoccluded.b;
        if (frame.view == "visibility")
            return glm::dvec3(sum > 0.0 ? (irradiance.r + irradiance.g + irradiance.b) / sum : 0.0);
        return radiance;
    }
    // [end:pixel]

    std::vector<const Light*> chosenLights(const Scene& scene, const std::string& view) const {
        const int count = int(scene.lights.size());
        if (light_ >= count) {
            throw UsageError("--light " + std::to_string(light_) + ": scene " + scene.name +
                             " has lights 0 to " + std::to_string(count - 1));
        }
        if (light_ >= 0) return {&scene.lights[std::size_t(light_)]};
        if (view == "visibility") return {&scene.lights[0]};
        std::vector<const Light*> all;
        for (const Light& light : scene.lights) all.push_back(&light);
        return all;
    }

    int samples_ = 64;
    int light_ = -1;
    float ambient_ = 0.08f;
    ShadowRayOptions options_;
    std::optional<RayTracer> tracer_;
};

}  // namespace

int main(int argc, char** argv) {
    const ChapterInfo info{
        "00_ray_traced_truth",
        "for each pixel a ray, for each light a shadow ray",
        {{"color", "Blinn-Phong with S(x), all lights"},
         {"visibility", "how much of the light is seen, 0 to 1", true},
         {"irradiance", "light that arrives, by the shading normal", false, false, 0.31830988618379067},
         {"rays", "shadow rays per pixel", true, true}},
        false};
    return runChapter<RayTracedTruth>(info, argc, argv);
}
