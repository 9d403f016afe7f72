#include "chapters/10_accumulated_occlusion/occlusion_options.h"

#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/10_accumulated_occlusion/accumulated_occlusion.h"
#include "chapters/10_accumulated_occlusion/visibility_sums.h"

namespace penumbra {

void OcclusionOptions::declare(Parameters& parameters) {
    parameters.add("samples", samples, 1, 4096, "",
                   "directions on the whole sphere, a shadow map each; 4: hard edges, 512: smooth and slow");
    parameters.add("directions", directions, directionPatternNames(),
                   "how they are spread; random: eight times as many for the same error");
    parameters.add("map-size", mapSize, 16, 4096, "texels",
                   "side of each map; 64: contacts leak, 4096: most of the time goes into clearing");
    parameters.add("depth-format", depthFormat, {"16", "24", "32f"},
                   "bits of a depth; 16: enough for most scenes, since nothing is lost to perspective");
    parameters.add("bias", bias, 0.0f, 32.0f, "",
                   "multiple of the derived bound; 0: acne darkens everything, 8: contacts leak");
    parameters.add("method", method, {"pixels", "vertices"},
                   "where A is added up; vertices: once, whatever the camera does, and blended between them");
    parameters.add("edges", edges, {"auto", "hard", "soft"},
                   "hard: a direction is seen or not; soft: the open share of the sky around it, from nine "
                   "look-ups; auto: soft for vertices, which are few");
    parameters.add("rotate", rotate,
                   "turns the pattern in every frame and goes on adding up while nothing changes");
    declareOcclusionSkips(parameters);
}

void declareOcclusionSkips(Parameters& parameters) {
    for (const Skip* skip : {&mapsBelowHorizon, &lookUpsFacingAway, &keptOcclusion, &clustersUnseen})
        parameters.skips().declare(*skip);
}

}  // namespace penumbra
