#include "chapters/08_accumulation/seen_receivers.h"

#include <cstdint>

#include "chapters/01_depth_from_light/shadow_options.h"
#include "chapters/08_accumulation/lit_sides.h"
#include "chapters/08_accumulation/other_surfaces.h"
#include "chapters/08_accumulation/stored_shadow.h"
#include "common/app/pass_timer.h"

namespace penumbra {

namespace {

/// A number below 2^24 as the bytes of a colour, which every context can draw into and read. 0: no receiver.
glm::vec4 colourOf(std::size_t number) {
    return glm::vec4(float(number & 255), float(number >> 8 & 255), float(number >> 16), 255.0f) / 255.0f;
}

/// Of all pixels of the bound framebuffer. Bytes, which OpenGL ES reads too.
std::vector<std::uint8_t> readColours(const glm::ivec2& size) {
    std::vector<std::uint8_t> bytes(4 * std::size_t(size.x) * std::size_t(size.y));
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    return bytes;
}

}  // namespace

SeenReceivers::SeenReceivers() : id_("08_accumulation/picture.vert", "08_accumulation/receiver_id.frag") {}

const std::vector<bool>& SeenReceivers::find(const Frame& frame, const std::vector<Receiver>& receivers,
                                             const std::vector<bool>& lit) {
    const bool same = camera_ && *camera_ == frame.camera && size_ == frame.size && lit_ == lit;
    if (same && frame.skips(keptShadows) && !frame.renderMapsAgain) return seen_;
    const PassScope scope(frame.passTimer, "seen");
    camera_ = frame.camera;
    size_ = frame.size;
    lit_ = lit;
    draw(frame, receivers, lit);
    seen_.assign(receivers.size(), false);
    const std::vector<std::uint8_t> bytes = readColours(frame.size);
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
        const std::size_t number =
            std::size_t(bytes[i]) | std::size_t(bytes[i + 1]) << 8 | std::size_t(bytes[i + 2]) << 16;
        if (number > 0) seen_[number - 1] = true;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glViewport(0, 0, frame.size.x, frame.size.y);
    return seen_;
}

// [begin:seen]
void SeenReceivers::draw(const Frame& frame, const std::vector<Receiver>& receivers,
                         const std::vector<bool>& lit) {
    if (!ids_ || ids_->size() != frame.size) ids_.emplace(frame.size, GL_RGBA8, true);
    ids_->clear(colourOf(0));
    const glm::dmat4 clip = clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y);
    id_.set("uClipFromWorld", glm::mat4(clip));
    id_.set("uId", colourOf(0));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    const DrawCounts whole =
        frame.gpu->drawShaded(id_, frame.skips(clustersUnseen) ? visibleClusters(frame.scene, Frustum(clip))
                                                               : allClusters(frame.scene));
    std::size_t calls = whole.drawCalls;
    drawLitSides(
        receivers, [&](std::size_t i) { return lit[i]; },
        [&](std::size_t i) {
            id_.set("uId", colourOf(i + 1));
            const Receiver& receiver = receivers[i];
            calls += frame.gpu->drawShaded(id_, receiver.part, rangesOf(receiver.triangles)).drawCalls;
        });
    frame.work["draw_calls"] += std::int64_t(calls);
}
// [end:seen]

}  // namespace penumbra
