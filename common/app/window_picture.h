// From a frame of a chapter to the pixels of the window.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "common/app/chapter_session.h"
#include "common/gl/fullscreen.h"
#include "common/gl/program.h"
#include "common/gl/render_target.h"

namespace penumbra {

class WindowPicture {
 public:
    WindowPicture(ChapterSession& session, const Context& context) : session_(session), context_(context) {}

    /// Renders the view, `divisor` times smaller than `size` in both directions if the chapter draws on the
    /// CPU. Waits until it is finished. Throws Error; the picture before is then gone or half drawn.
    void render(const std::string& view, const Camera& camera, const glm::ivec2& size, int divisor);
    /// Into the window, of `size` pixels.
    void present(const glm::ivec2& size);

 private:
    void upload(const FloatImage& shown);

    ChapterSession& session_;
    const Context& context_;
    Program present_{"common/fullscreen.vert", "common/present.frag"};
    FullscreenTriangle triangle_;
    std::optional<RenderTarget> target_;
    GlTexture uploaded_;  ///< linear, for the screen already
    bool showUploaded_ = false;
    bool scalar_ = false;
    float exposure_ = 0.0f;
};

}  // namespace penumbra
