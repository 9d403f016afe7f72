#include "chapters/07_branching/branching_options.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/error.h"

namespace penumbra {

void BranchingOptions::declare(Parameters& parameters) {
    jitter.declare(parameters);
    parameters.add("classify", classify, {"min-max", "probe", "none"},
                   "who may skip the taps; probe: the lecture's eight, which miss wires; none: nobody");
    parameters.add("branch", branch, {"loop", "if"},
                   "how they are skipped; if: a CPU rasteriser runs both sides and gains nothing");
    parameters.add("penumbra", penumbra, {"fixed", "contact-hardening"},
                   "width of the kernel; contact-hardening: of the area light, --radius at most");
    parameters.skips().declare(keptMinMax);
}

void BranchingOptions::load(const Scene& scene) {
    jitter.reset();
    minMax_.reset();
    planes_ = largestPlanes(scene);
    floor_.emplace(scene);
}

std::vector<std::string> BranchingOptions::defines(int view) const {
    std::vector<std::string> defines = jitter.defines(view);
    if (hardening()) defines.emplace_back("CONTACT_HARDENING");
    if (hardening() && classify != "min-max")
        throw UsageError("--penumbra contact-hardening: searches by the minima; leave --classify at min-max");
    defines.emplace_back(classify == "min-max" ? "CLASSIFY_MIN_MAX"
                         : classify == "probe" ? "CLASSIFY_PROBE"
                                               : "CLASSIFY_NONE");
    // The bound of the loop is a constant then, and the compiler writes the tests out one after the other.
    if (branch == "if") defines.push_back(fmt::format("BRANCH_IF {}", jitter.samples / 8));
    return defines;
}

float BranchingOptions::reach() const {
    // A bilinear tap reads half a texel further. A sampler may round coordinates to 1/256 of a texel.
    const bool bilinear = jitter.method == "texture" && jitter.layout == "lecture";
    return jitter.radius + (bilinear ? 0.5f : 0.0f) + 1.0f / 64.0f;
}

void BranchingOptions::set(Program& program, const ShadowMap& map, const LightFrustum& frustum,
                           const Light& light, const Frame& frame) {
    jitter.set(program, map, frustum, frame);
    if (classify == "min-max") {
        if (!minMax_) minMax_.emplace(frame.context->capabilities().textureGather);
        minMax_->build(map, frustum.range, dominantSlopes(planes_, frustum, light), reach(), frame);
        minMax_->set(program);
    }
    if (hardening()) setLightSize(program, frustum, light);
    CasterReach casters;
    if (classify != "none") casters = casterReach(frame.scene, *floor_, light, frustum, reach(), map.size());
    program.set("uCasters", casters.st);
    program.set("uNearestCaster", casters.nearest);
}

void BranchingOptions::setLightSize(Program& program, const LightFrustum& frustum, const Light& light) {
    if (light.type != LightType::area)
        throw UsageError("--penumbra contact-hardening: light " + light.name +
                         " is no area light, and its shadows are hard everywhere");
    program.set("uLightRadius", float(std::sqrt(light.area / std::numbers::pi)));
    program.set("uHalfExtent", glm::vec2(frustum.halfExtent));
    program.set("uNearFar", glm::vec2(frustum.near, frustum.far));
}

void BranchingOptions::count(const PixelCounts& pixels, WorkCounters& work) const {
    work["pixels_receiving"] += pixels.receiving;
    work["pixels_out_of_reach"] += pixels.receiving - pixels.looked;
    work["pixels_supersampled"] += pixels.searched;
    if (classify == "min-max") work["min_max_lookups"] += pixels.looked;
    work["visibility_tests"] += classify == "probe"
                                    ? 8 * pixels.looked + (jitter.samples - 8) * pixels.searched
                                    : jitter.samples * pixels.searched;
}

std::vector<Program*> BranchingOptions::programs() {
    return minMax_ ? minMax_->programs() : std::vector<Program*>{};
}

}  // namespace penumbra
