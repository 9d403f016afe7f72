#include "chapters/06_jitter_texture/jitter_options.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra {

void JitterOptions::declare(Parameters& parameters) {
    parameters.add("radius", radius, 0.0f, 256.0f, "texels",
                   "of the disk; 0: the staircase of one test, 256: soft, and contacts are blurred");
    parameters.add("samples", samples, 8, 256, "",
                   "tests on the disk, a multiple of 8; 8: noise, 256: smooth, slow");
    parameters.add("method", method, {"texture", "rotation"},
                   "where a pixel's pattern comes from; rotation: one spiral, turned by a hash of the pixel");
    parameters.add("tile", tile, 4, 64, "pixels",
                   "side of the tile of patterns; 4: the eye finds the repetition, 64: a slow start");
    parameters.add("order", order, jitterOrderNames(),
                   "of the patterns in the tile; white: mottled; blue: errors of neighbours compensate");
    parameters.add("layout", layout, jitterLayoutNames(),
                   "of the pattern texture: samples in one texel, bits of a coordinate; packed8: steps of "
                   "radius/127");
    bias.declare(parameters);
}

std::vector<std::string> JitterOptions::defines(int view) const {
    const PolarGrid checked(samples);
    const std::string shown = fmt::format("VIEW {}", view);
    if (method == "rotation") return {shown, "JITTER_ROTATION"};
    if (layout == "packed16") return {shown, "JITTER_PACKED16"};
    if (layout == "snorm8") return {shown, "JITTER_SNORM8"};
    if (layout == "lecture") return {shown, "JITTER_LECTURE"};
    return {shown, "JITTER_PACKED8"};
}

void JitterOptions::set(Program& program, const ShadowMap& map, const LightFrustum& frustum,
                        const Frame& frame) {
    bias.set(program, map, frustum, frame.scene);
    program.set("uRadius", radius);
    program.set("uSamples", samples);
    const bool reversed = frustum.range == DepthRange::reversed;
    const bool bilinear = method == "texture" && layout == "lecture";
    std::optional<CompareSampler>& compare = compare_[reversed][bilinear];
    if (!compare) compare.emplace(frustum.range, bilinear ? GL_LINEAR : GL_NEAREST);
    program.setTexture("uShadowCompare", GL_TEXTURE_2D, map.texture(), compare->id());
    program.set("uSeed", int(frame.seed));

    const Key wanted{tile, samples, order, layout, frame.seed};
    if (method == "texture" && held_ != wanted) {
        const auto& names = jitterLayoutNames();
        const auto chosen = JitterLayout(std::find(names.begin(), names.end(), layout) - names.begin());
        const auto& orders = jitterOrderNames();
        const auto wantedOrder = JitterOrder(std::find(orders.begin(), orders.end(), order) - orders.begin());
        texture_.emplace(JitterTile(tile, samples, wantedOrder, frame.seed), chosen);
        held_ = wanted;
    }
    if (method == "texture") program.setTexture("uJitter", GL_TEXTURE_3D, texture_->id());
    program.fix({"uFarther", "uOutsideLit", "uBehindLit", "uLightType", "uFollowPlane", "uBias", "uSamples",
                 "uSnap", "uQuantum"});
}

void JitterOptions::reset() {
    held_.reset();
    texture_.reset();
    for (auto& row : compare_)
        for (auto& sampler : row) sampler.reset();
}

}  // namespace penumbra
