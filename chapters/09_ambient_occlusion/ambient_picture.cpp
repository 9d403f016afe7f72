#include "chapters/09_ambient_occlusion/ambient_picture.h"

#include <algorithm>
#include <array>

#include "chapters/01_depth_from_light/shadow_options.h"

namespace penumbra {

namespace {

int viewNumber(const std::string& view) {
    constexpr std::array<const char*, 5> names{"color", "ambient", "bent-normal", "irradiance", "work"};
    if (view == "visibility") return 1;
    return int(std::find(names.begin(), names.end(), view) - names.begin());
}

}  // namespace

void AmbientPicture::begin(Program& program, const Frame& frame, const AmbientOptions& options) {
    backdrop_.draw(frame, options, frame.view == "color");
    glEnable(GL_DEPTH_TEST);
    program.set("uClipFromWorld",
                glm::mat4(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y)));
    program.set("uOnOpenGround", glm::vec3(options.light(frame.scene).onOpenGround));
    program.set("uView", viewNumber(frame.view));
}

void AmbientPicture::drawHemisphere(const Frame& frame, const AmbientOptions& options) {
    options.light(frame.scene);
    Program& program = options.weighting == "uniform" ? hemisphereUniform_ : hemisphere_;
    begin(program, frame, options);
    drawPicture(program, frame);
}

void AmbientPicture::drawPixels(const Frame& frame, const AmbientOptions& options, const PixelRays& pixels) {
    begin(pixels_, frame, options);
    pixels_.setTexture("uStored", GL_TEXTURE_2D, pixels.values());
    pixels_.setTexture("uLight", GL_TEXTURE_2D, pixels.light());
    drawPicture(pixels_, frame);
}

void AmbientPicture::drawBaked(const Frame& frame, const AmbientOptions& options, const BakedAmbient& baked) {
    begin(stored_, frame, options);
    baked.draw(stored_, frame);
}

void AmbientPicture::show(const Frame& frame, const std::vector<float>& picture) {
    if (!picture_ || picture_->size() != frame.size) picture_.emplace(frame.size, GL_RGBA32F);
    picture_->upload(picture);
    shown_.setTexture("uPicture", GL_TEXTURE_2D, picture_->id());
    shown_.prepareToDraw();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
}

std::vector<Program*> AmbientPicture::programs() {
    return {&hemisphere_, &hemisphereUniform_, &pixels_, &stored_, &backdrop_.program(), &shown_};
}

}  // namespace penumbra
