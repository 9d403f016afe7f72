#include "chapters/09_ambient_occlusion/ambient_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/09_ambient_occlusion/pixel_rays.h"
#include "common/error.h"
#include "common/scene/light.h"

namespace penumbra {

namespace {

const std::map<std::string, glm::dvec3> sides{
    {"east", {1, 0, 0}}, {"west", {-1, 0, 0}}, {"north", {0, 0, -1}}, {"south", {0, 0, 1}}};

Light sunOf(const Scene& scene) {
    const auto sun = std::find_if(scene.lights.begin(), scene.lights.end(),
                                  [](const Light& light) { return light.type == LightType::directional; });
    if (sun == scene.lights.end())
        throw UsageError(fmt::format("--sun on: scene {} has no directional light", scene.name));
    return *sun;
}

}  // namespace

void declareReach(Parameters& parameters, float& range, std::string& falloff) {
    parameters.add("range", range, 0.0f, 1000.0f, "metres",
                   "only surfaces so near occlude; 0: all do, and rooms are black");
    parameters.add("falloff", falloff, {"hard", "smooth"},
                   "towards the end of the range; hard: a contour where it ends");
}

void declareSky(Parameters& parameters, std::string& sky) {
    parameters.addOrFile("sky", sky, Sky::names(),
                         "what shines: a name, or a latitude-longitude picture (.hdr, .exr)");
}

void AmbientOptions::declare(Parameters& parameters) {
    parameters.add("method", method, {"hemisphere", "rays", "vertices", "triangles", "bits", "stored"},
                   "hemisphere: by the normal alone; rays: at each pixel; vertices, triangles: baked; bits: "
                   "S(x, l) of each vertex, relit; stored: as the scene's file has it");
    parameters.add("samples", samples, 1, 4096, "",
                   "rays at a pixel or a point, or directions of the bits; 4: grain, 1024: smooth and slow");
    parameters.add("weighting", weighting, {"cosine", "uniform"},
                   "how directions count; uniform: rays are counted, and valleys are flat");
    declareReach(parameters, range, falloff);
    declareSky(parameters, sky);
    parameters.add("sky-part", skyPart, {"all", "east", "west", "north", "south"},
                   "the half of the sky that is on; bits are kept, so no ray is traced again");
    parameters.add("sun", sun, "the scene's first directional light shines too (methods rays and bits)");
    parameters.add("values", values, {"points", "least-squares"},
                   "of --method vertices; points: a vertex under a box darkens all around it");
    parameters.add("share", share, "baking: neighbours use one another's rays where that costs no accuracy");
    parameters.addOrFile("save", save, {"none"},
                         "writes the scene with its baked values as a .glb; draw it with --method stored");
    parameters.add("truth-rays", truthRays, 64, 65536, "",
                   "rays at a pixel of the exact answer; the report says its standard error");
    declareAmbientSkips(parameters);
}

void declareAmbientSkips(Parameters& parameters) {
    for (const Skip* skip : {&raysToOpenSky, &keptRays, &clustersUnseen}) parameters.skips().declare(*skip);
}

AmbientRays AmbientOptions::rays() const {
    AmbientRays result;
    result.count = samples;
    result.weighting = weighting == "cosine" ? Weighting::cosine : Weighting::uniform;
    if (range > 0.0f) result.reach.range = double(range);
    result.reach.smooth = falloff == "smooth";
    return result;
}

const SkyLight& AmbientOptions::light(const Scene& scene) const {
    const std::string wanted = scene.source + " " + lightKey();
    if (light_ && madeOf_ == wanted) return *light_;
    SkyLight made{Sky::named(sky).times(1.0 / double(exposure(scene, -1))), glm::dvec3(0.0), std::nullopt};
    if (skyPart != "all") made.sky = made.sky.onlySide(sides.at(skyPart));
    made.onOpenGround = made.sky.onOpenGround();
    if (sun) made.sun = sunOf(scene);
    if (sun && method != "rays" && method != "bits")
        throw UsageError("--sun on: a stored mean does not know where the sun is; use --method rays or bits");
    light_ = made;
    madeOf_ = wanted;
    return *light_;
}

std::string AmbientOptions::visibilityKey(std::uint32_t seed) const {
    return fmt::format("{} {} {} {} {} {} {} {} {}", method, samples, weighting, range, falloff, values,
                       share, atEdges, seed);
}

std::string AmbientOptions::lightKey() const {
    return fmt::format("{} {} {} {}", method, sky, skyPart, sun);
}

}  // namespace penumbra
