#include "chapters/11_bent_normals/bent_options.h"

#include <fmt/format.h>

#include "common/error.h"

namespace penumbra {

void BentOptions::declare(Parameters& parameters) {
    parameters.add("source", source, {"rays", "edges", "vertices", "maps"},
                   "where A and B come from; rays: each pixel's (chapter 09), edges: half of them where open "
                   "and blocked meet, vertices: baked, maps: shadow maps (chapter 10)");
    parameters.add("samples", samples, 1, 4096, "",
                   "rays at a point, or shadow maps; 4: grain or hard edges, 1024: smooth and slow");
    parameters.add("weighting", weighting, {"cosine", "uniform"},
                   "how open directions count; uniform: the lecture's loop, B leans too far");
    declareReach(parameters, range, falloff);
    parameters.add("lookup", lookUp, {"normal", "bent"},
                   "direction in which the irradiance is looked up; normal: an arch is lit by its own wall");
    parameters.add(
        "irradiance", irradiance, {"sh", "map", "linear", "normalised"},
        "sh: nine numbers; map: a picture; linear: four numbers and (A, B) as they are; normalised: "
        "the same with B of length 1, too bright");
    declareSky(parameters, sky);
    parameters.add("combine", combine, {"principled", "adhoc", "none"},
                   "principled: A E(B) of the sky; adhoc: A times the lamp's n.l; none: the lamp alone");
    parameters.add("light", light, 0, 63, "", "index of the lamp of adhoc, none and --view diffuse");
    parameters.add("map-size", mapSize, 16, 8192, "texels",
                   "side of a shadow map of --source maps; 64: leaks, 4096: slow");
    parameters.add("truth-rays", truthRays, 64, 65536, "", "rays at a pixel of the exact answer");
    parameters.skips().declare(skyNotShown);
    declareAmbientSkips(parameters);
    declareOcclusionSkips(parameters);
}

void BentOptions::requireSense() const {
    if (isLinear() && weighting == "uniform")
        throw UsageError("--irradiance linear takes the cosine-weighted pair; leave --weighting at cosine");
    if (source == "edges" && samples < 2)
        throw UsageError(
            "--source edges: looks a second time with half of the rays; use --samples 2 or more");
    if (source == "maps" && weighting == "uniform")
        throw UsageError(
            "--source maps: adds up by the cosine; use --source rays or edges with --weighting uniform");
    if (source == "maps" && range > 0.0f)
        throw UsageError(
            "--range with --source maps: a shadow map knows what is nearest to the sky, not to the point; "
            "use --source rays or vertices, or --range 0");
}

const AmbientOptions& BentOptions::ambient() const {
    ambient_.method = source == "vertices" ? "vertices" : "rays";
    ambient_.atEdges = source == "edges";
    ambient_.samples = samples;
    ambient_.weighting = weighting;
    ambient_.range = range;
    ambient_.falloff = falloff;
    return ambient_;
}

const AmbientOptions& BentOptions::shining() const {
    shining_.sky = sky;
    return shining_;
}

const OcclusionOptions& BentOptions::occlusion() const {
    occlusion_.samples = samples;
    occlusion_.mapSize = mapSize;
    return occlusion_;
}

const Light& BentOptions::lamp(const Scene& scene) const {
    if (light >= int(scene.lights.size()))
        throw UsageError(fmt::format("--light {}: scene {} has lights 0 to {}", light, scene.name,
                                     scene.lights.size() - 1));
    return scene.lights[std::size_t(light)];
}

}  // namespace penumbra
