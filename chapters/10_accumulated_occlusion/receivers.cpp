#include "chapters/10_accumulated_occlusion/receivers.h"

#include <cmath>

#include "chapters/01_depth_from_light/shadow_options.h"
#include "common/app/pass_timer.h"
#include "common/scene/camera.h"

namespace penumbra {

Receivers::Receivers() : surface_("08_accumulation/picture.vert", "10_accumulated_occlusion/surface.frag") {}

void Receivers::resize(const glm::ivec2& size) {
    if (size_ == size) return;
    size_ = size;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    GLenum attachment = GL_COLOR_ATTACHMENT0;
    for (std::optional<TexelTexture>* texture : {&positions_, &normals_, &facets_}) {
        texture->emplace(size, GL_RGBA32F);
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachment++, GL_TEXTURE_2D, (*texture)->id(), 0);
    }
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size.x, size.y);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    const GLenum targets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    glDrawBuffers(3, targets);
    requireCompleteFramebuffer("textures of positions and normals");
}

void Receivers::drawPixels(const Frame& frame) {
    const PassScope scope(frame.passTimer, "receivers");
    resize(frame.size);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, size_.x, size_.y);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    surface_.set("uClipFromWorld",
                 glm::mat4(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y)));
    drawPicture(surface_, frame);
}

void Receivers::uploadVertices(const Scene& scene) {
    const std::size_t count = scene.positions.size();
    const int width = std::max(1, int(std::ceil(std::sqrt(double(count)))));
    resize({width, std::max(1, (int(count) + width - 1) / width)});
    const std::size_t texels = std::size_t(size_.x) * std::size_t(size_.y);
    std::vector<float> positions(4 * texels), normals(4 * texels);
    for (std::size_t i = 0; i < count; ++i) {
        for (int c = 0; c < 3; ++c) {
            positions[4 * i + std::size_t(c)] = scene.positions[i][c];
            normals[4 * i + std::size_t(c)] = scene.normals[i][c];
        }
        positions[4 * i + 3] = 1.0f;
    }
    positions_->upload(positions);
    normals_->upload(normals);
    facets_->upload(normals);
}

std::vector<glm::vec4> Receivers::readNormals() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    return readTexels(size_);
}

}  // namespace penumbra
