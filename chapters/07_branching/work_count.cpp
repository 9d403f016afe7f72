#include "chapters/07_branching/work_count.h"

#include "common/scene/culling.h"

namespace penumbra {

const PixelCounts& WorkCount::count(const Frame& frame, const std::string& state,
                                    const std::function<Program&()>& prepare) {
    if (target_ && target_->size() == frame.size && state == state_) return counts_;
    if (!target_ || target_->size() != frame.size)
        target_ = std::make_unique<RenderTarget>(frame.size, frame.context->capabilities());
    Program& program = prepare();
    target_->bind();
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    frame.gpu->drawShaded(program, allClusters(frame.scene));
    const FloatImage flags = target_->read(3);
    counts_ = {};
    for (std::size_t i = 0; i < flags.values.size(); i += 3) {
        counts_.receiving += flags.values[i] > 0.5f;
        counts_.looked += flags.values[i + 1] > 0.5f;
        counts_.searched += flags.values[i + 2] > 0.5f;
    }
    state_ = state;
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glViewport(0, 0, frame.size.x, frame.size.y);
    return counts_;
}

}  // namespace penumbra
