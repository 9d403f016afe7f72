#include "chapters/08_accumulation/received_light.h"

#include <fmt/format.h>

#include "chapters/08_accumulation/slow_frame.h"
#include "chapters/08_accumulation/texture_room.h"
#include "common/app/pass_timer.h"

namespace penumbra {

namespace {

/// A light of a frame, and its shadow on each receiver.
struct LitLight {
    std::vector<StoredShadow>& shadows;
    const Light& whole;
    Light lit;
};

}  // namespace

ReceivedLight::ReceivedLight() : compose_("common/fullscreen.vert", "08_accumulation/compose.frag") {}

void ReceivedLight::reset() {
    receivers_.clear();
    receiversKey_.clear();
    shadows_.clear();
    textures_.clear();
    composed_.clear();
    seen_.forget();
}

void ReceivedLight::findReceivers(const Frame& frame, const AccumulationOptions& options) {
    const std::string key = fmt::format("{} {} {} {}", options.maps.light, options.texelsPerMetre,
                                        options.texelBudget, options.minimumArea);
    if (key == receiversKey_) return;
    reset();
    receiversKey_ = key;
    receivers_ = penumbra::findReceivers(frame.scene, options.receiverRequest(frame.scene));
    textures_.resize(receivers_.size());
    composed_.resize(receivers_.size());
    for (const int light : options.chosenLights(frame.scene)) shadows_[light].resize(receivers_.size());
}

std::string ReceivedLight::composedKey(const AccumulationOptions& options, Output output,
                                       std::size_t i) const {
    std::string key = fmt::format("{} {}", options.lightKey(), int(output));
    for (const auto& [light, shadows] : shadows_) key += fmt::format(" {}", shadows[i].revision());
    return key;
}

std::vector<bool> ReceivedLight::unseen(const Frame& frame, const std::vector<int>& lights) {
    std::vector<bool> lit;
    for (const Receiver& receiver : receivers_) lit.push_back(receivesAny(receiver, frame.scene, lights));
    const std::vector<bool>& seen = seen_.find(frame, receivers_, lit);
    std::vector<bool> result;
    for (std::size_t i = 0; i < receivers_.size(); ++i) result.push_back(lit[i] && !seen[i]);
    return result;
}

void ReceivedLight::update(const Frame& frame, const AccumulationOptions& options, Output output, For shown) {
    findReceivers(frame, options);
    requireTextureRoom(options, frame.scene, receivers_);
    frame.work["occluders_drawn"] += 0;
    const bool visibility = output != Output::irradiance;
    std::vector<LitLight> lights;
    std::vector<int> indices;
    for (auto& [index, shadows] : shadows_) {
        const Light& whole = frame.scene.lights[std::size_t(index)];
        lights.push_back({shadows, whole, options.lit(frame.scene, index)});
        indices.push_back(index);
        if (visibility) break;  // of the first light
    }
    std::vector<bool> leftOut(receivers_.size(), false);
    if (shown == For::picture && frame.skips(receiversUnseen)) leftOut = unseen(frame, indices);
    const ProgressCallback slowProgress = slowFrameProgress(frame);
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
        if (leftOut[i]) {
            // What its texture holds is of an earlier frame, and is filled again before it is seen.
            frame.work["receivers"] += std::int64_t(lights.size());
            frame.work["receivers_unseen"] += std::int64_t(lights.size());
            continue;
        }
        bool arrives = false;
        for (std::size_t k = 0; k < lights.size(); ++k) {
            const LitLight& light = lights[k];
            const auto progress = [&](double fraction) {
                slowProgress((double(i * lights.size() + k) + fraction) /
                             double(receivers_.size() * lights.size()));
            };
            light.shadows[i].update({frame, options, receivers_[i], light.whole, light.lit, progress},
                                    passes_);
            progress(1.0);
            arrives = arrives || light.shadows[i].plan().receives;
        }
        if (!arrives) {
            textures_[i].reset();
            continue;
        }
        const std::string key = composedKey(options, output, i);
        if (key == composed_[i] && frame.skips(keptTextures) && !frame.renderMapsAgain) continue;
        composed_[i] = key;
        frame.work["textures_composed"] += 1;
        const PassScope scope(frame.passTimer, "compose");
        if (!textures_[i])
            textures_[i].emplace(receivers_[i].texels, sumFormat(frame.context->capabilities(), "32f"));
        textures_[i]->clear(glm::vec4(0.0f));
        for (const LitLight& light : lights)
            compose({frame, options, receivers_[i], light.whole, light.lit}, light.shadows[i], output,
                    *textures_[i]);
    }
    const bool relit = !lightKey_.empty() && lightKey_ != options.lightKey();
    if (relit && frame.work["occluders_drawn"] == 0) frame.work["relit"] = 1;
    lightKey_ = options.lightKey();
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glViewport(0, 0, frame.size.x, frame.size.y);
}

void ReceivedLight::compose(const StoredShadow::Request& request, StoredShadow& shadow, Output output,
                            const TexelTarget& target) {
    if (!shadow.plan().receives) return;
    const bool sum = request.options.weights == "sum" && shadow.plan().reached;
    const bool needsUnoccluded = output == Output::irradiance || sum;
    const PackedSums* packed = shadow.packedSums();
    compose_.setTexture("uSums", GL_TEXTURE_2D, shadow.sums() ? shadow.sums()->texture() : 0);
    compose_.setTexture("uSeen", GL_TEXTURE_2D, packed ? packed->seen() : 0);
    compose_.setTexture("uAll", GL_TEXTURE_2D, packed ? packed->all() : 0);
    compose_.set("uPacked", packed != nullptr);
    compose_.setTexture("uUnoccluded", GL_TEXTURE_2D, needsUnoccluded ? shadow.unoccluded(request) : 0);
    compose_.set("uKnown", shadow.plan().reached ? 0 : 1);
    compose_.set("uRatio", !sum || request.options.method == "exact");
    compose_.set("uHasUnoccluded", needsUnoccluded);
    compose_.set("uEmission", glm::vec3(request.lit.emission));
    compose_.set("uOutput", int(output));
    compose_.set("uInFront", heightInFrontOf(request.lit, request.receiver));
    compose_.set("uWeightScale", float(shadow.weightScale()));
    compose_.set("uTextureSize", glm::vec2(target.size()));
    compose_.prepareToDraw();
    target.bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    triangle_.draw();
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);
}

std::vector<Program*> ReceivedLight::programs() {
    std::vector<Program*> all = passes_.accumulate.programs(), masks = passes_.mask.programs();
    all.insert(all.end(), masks.begin(), masks.end());
    all.insert(all.end(), {&seen_.program(), &compose_});
    return all;
}

}  // namespace penumbra
