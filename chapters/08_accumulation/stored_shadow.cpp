#include "chapters/08_accumulation/stored_shadow.h"

#include <algorithm>

#include "chapters/08_accumulation/exact_receiver.h"
#include "chapters/08_accumulation/unoccluded_texture.h"
#include "common/app/pass_timer.h"

namespace penumbra {

GLenum sumFormat(const Capabilities& capabilities, const std::string& target) {
    // Two sums in four channels: what an accumulation buffer has, and what can be drawn into everywhere.
    if (target == "8") return GL_RGBA8;
    if (target == "rg32f" && capabilities.floatBlend) return GL_RG32F;
    return target == "16f" || !capabilities.floatBlend ? GL_RGBA16F : GL_RGBA32F;
}

// [begin:stored]
void StoredShadow::update(const Request& request, ShadowPasses& passes) {
    const Frame& frame = request.frame;
    const std::string shadowKey = request.options.shadowKey(frame.seed),
                      lightKey = request.options.lightKey();
    const bool kept = frame.skips(keptShadows) && !frame.renderMapsAgain && shadowKey == shadowKey_;
    if (!kept) drawShadows(request, passes);
    // The masks know each point by itself: other weights need no occluder again. Sums have forgotten.
    const bool same = kept && lightKey == lightKey_;
    const bool hasMasks = request.options.method == "mask";
    if (plan_.reached && !same && hasMasks) addWeights(request, passes);
    if (plan_.reached && kept && !same && !hasMasks) drawShadows(request, passes);
    if (!same) ++revision_;
    shadowKey_ = shadowKey;
    lightKey_ = lightKey;
    count(request);
}
// [end:stored]

void StoredShadow::drawShadows(const Request& request, ShadowPasses& passes) {
    const AccumulationOptions& options = request.options;
    const Frame& frame = request.frame;
    {
        const PassScope scope(frame.passTimer, "plan");
        plan_ = planShadows(frame.scene, request.receiver, request.whole,
                            options.points(request.whole, options.samples, frame.seed), frame.skips);
    }
    if (!plan_.reached) {
        sums_.reset();
        packed_.reset();
        masks_.reset();
        return;
    }
    provideSums(request);
    if (options.method == "exact") return solve(request);
    if (options.method == "accumulate") {
        const PassScope scope(frame.passTimer, "accumulate");
        const PointWeights weights = weightsOf(request);
        scale_ = weights.scale;
        passes.accumulate.run(frame, request.receiver, plan_, request.whole.part, weights.values,
                              options.weights, *sums_);
        return;
    }
    const bool stencil = options.masks == "stencil" || !frame.context->capabilities().logicOp;
    const BitSetting setting = stencil ? BitSetting::stencil : BitSetting::logicOp;
    const int points = std::max(1, int(plan_.points.size()));
    if (!masks_ || masks_->size() != request.receiver.texels || masks_->points() != points ||
        masks_->setting() != setting) {
        masks_.reset();
        masks_.emplace(request.receiver.texels, points, setting);
    }
    passes.mask.draw(frame, plan_, request.whole.part, *masks_);
}

void StoredShadow::provideSums(const Request& request) {
    const AccumulationOptions& options = request.options;
    const Capabilities& capabilities = request.frame.context->capabilities();
    const glm::ivec2 texels = request.receiver.texels;
    if (options.method == "mask") {
        sums_.reset();
        if (!packed_ || packed_->texels() != texels) packed_.emplace(texels, sumFormat(capabilities, "32f"));
        return;
    }
    packed_.reset();
    masks_.reset();
    const GLenum format = sumFormat(capabilities, options.method == "accumulate" ? options.target : "32f");
    if (!sums_ || sums_->size() != texels || sums_->format() != format) sums_.emplace(texels, format);
}

std::vector<glm::vec2> StoredShadow::readSums() const {
    if (packed_) return packed_->read();
    std::vector<glm::vec2> values;
    if (sums_)
        for (const glm::vec4& sum : sums_->read()) values.emplace_back(sum);
    return values;
}

PointWeights StoredShadow::weightsOf(const Request& request) const {
    std::vector<bool> on;
    for (const LightPoint& point : plan_.points)
        on.push_back(inLightPart(request.whole, request.options.lightPart, point.position));
    return pointWeights(request.receiver, plan_.points, on);
}

void StoredShadow::addWeights(const Request& request, ShadowPasses& passes) {
    const PassScope scope(request.frame.passTimer, "resolve");
    const PointWeights weights = weightsOf(request);
    scale_ = weights.scale;
    const bool everywhere = !request.frame.skips(texelsAgreeing) || request.options.weights == "sum";
    passes.mask.resolve(request.receiver, plan_, weights.values, request.options.weights, everywhere, *masks_,
                        *packed_);
    weighedEverywhere_ = everywhere;
}

void StoredShadow::solve(const Request& request) {
    const PassScope scope(request.frame.passTimer, "exact");
    const ExactIrradiance visible = exactIrradiance(request.receiver, request.lit, plan_.occluders.reaching,
                                                    request.frame.skips(trianglesOffBlock), request.progress);
    const std::vector<double> all = unoccludedIrradiance(request.receiver, request.lit);
    std::vector<float> values;
    values.reserve(4 * all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const double value : {visible.values[i], double(all[i]), 0.0, 0.0})
            values.push_back(float(value));
    sums_->upload(values);
    request.frame.work["texels_solved"] += visible.shadowTexels;
    request.frame.work["triangle_tests"] += visible.triangleTests;
}

GLuint StoredShadow::unoccluded(const Request& request) {
    const std::string key = request.options.shadowKey(request.frame.seed) + request.options.lightPart;
    if (unoccluded_ && key == unoccludedKey_ && request.frame.skips(keptShadows) &&
        !request.frame.renderMapsAgain)
        return unoccluded_->id();
    const PassScope scope(request.frame.passTimer, "unoccluded");
    unoccludedKey_ = key;
    if (!unoccluded_ || unoccluded_->size() != request.receiver.texels)
        unoccluded_.emplace(request.receiver.texels, GL_R32F);
    unoccluded_->upload(unoccludedTexture(request.receiver, request.lit));
    return unoccluded_->id();
}

/// Behind the light's plane all is dark, whatever the mask holds there: which occluders are drawn
/// (clustersNotBetween) would change the count, and nothing else.
std::int64_t StoredShadow::mixedTexels(const Request& request) const {
    const std::vector<glm::vec2> sums = readSums();
    const glm::vec3 inFront = heightInFrontOf(request.lit, request.receiver);
    const glm::ivec2 texels = request.receiver.texels;
    std::int64_t count = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::size_t row = i / std::size_t(texels.x), column = i % std::size_t(texels.x);
        const glm::vec2 centre(float(column) + 0.5f, float(row) + 0.5f);
        count += sums[i].x > 0.0f && sums[i].x < sums[i].y &&
                 glm::dot(inFront, glm::vec3(centre / glm::vec2(texels), 1.0f)) > 0.0f;
    }
    return count;
}

void StoredShadow::count(const Request& request) {
    WorkCounters& work = request.frame.work;
    work["receivers"] += 1;
    work["receivers_updated"] += 1;
    work["receivers_facing_away"] += !plan_.receives;
    work["receivers_unreached"] += plan_.receives && !plan_.reached;
    work["receivers_shadowed"] += plan_.reached;
    const std::int64_t texels = std::int64_t(request.receiver.texels.x) * request.receiver.texels.y;
    work["texels"] += texels;
    work["texels_in_reach"] += plan_.texelsInReach;
    // Once for each change: a timed frame does not read back.
    const std::string key = shadowKey_ + lightKey_;
    if (plan_.reached && key != countedKey_) mixed_ = mixedTexels(request);
    countedKey_ = key;
    work["texels_mixed"] += plan_.reached ? mixed_ : 0;
    if (masks_) work["texels_weighed"] += weighedEverywhere_ ? texels : mixed_;
}

}  // namespace penumbra
