#include "common/app/window_picture.h"

#include <algorithm>
#include <vector>

namespace penumbra {

void WindowPicture::render(const std::string& view, const Camera& camera, const glm::ivec2& size,
                           int divisor) {
    const ViewInfo& info = session_.view(view);
    FrameRequest request{.view = view, .camera = camera, .size = size};
    if (!session_.context()) {
        request.size = glm::max(size / divisor, glm::ivec2(1));
        session_.render(request);
        upload(session_.display(session_.cpuPicture(), info));
        return;
    }
    if (!target_ || target_->size() != size) target_.emplace(size, context_.capabilities());
    request.framebuffer = target_->framebuffer();
    session_.render(request);
    glFinish();
    if (info.scalar && info.falseColour) {  // its range is that of the whole picture
        upload(session_.display(target_->read(1), info));
        return;
    }
    showUploaded_ = false;
    scalar_ = info.scalar;
    exposure_ = info.scalar ? 1.0f : session_.exposureOf(info);
}

void WindowPicture::upload(const FloatImage& shown) {
    std::vector<float> rgb;
    rgb.reserve(3 * std::size_t(shown.width) * std::size_t(shown.height));
    for (int y = shown.height - 1; y >= 0; --y)  // OpenGL's first row is at the bottom
        for (int x = 0; x < shown.width; ++x)
            for (int c = 0; c < 3; ++c) rgb.push_back(shown.at(x, y, std::min(c, shown.channels - 1)));
    glBindTexture(GL_TEXTURE_2D, uploaded_.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, shown.width, shown.height, 0, GL_RGB, GL_FLOAT, rgb.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    showUploaded_ = true;
}

void WindowPicture::present(const glm::ivec2& size) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    for (const GLenum test : {GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST}) glDisable(test);
    if (!target_ && !showUploaded_) return;
    present_.set("uScalar", !showUploaded_ && scalar_);
    present_.set("uExposure", showUploaded_ ? 0.0f : exposure_);
    present_.setTexture("uPicture", GL_TEXTURE_2D, showUploaded_ ? uploaded_.id() : target_->colorTexture());
    present_.prepareToDraw();
    triangle_.draw();
}

}  // namespace penumbra
