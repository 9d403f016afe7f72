#include "chapters/09_ambient_occlusion/ambient_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chapters/01_depth_from_light/shadow_options.h"

namespace penumbra {

namespace {

int viewNumber(const std::string& view) {
    constexpr std::array<const char*, 5> names{"color", "ambient", "bent-normal", "irradiance", "work"};
    if (view == "visibility") return 1;
    return int(std::find(names.begin(), names.end(), view) - names.begin());
}

/// Texel centres of a latitude-longitude picture, row 0 up.
std::vector<float> latLongTexels(const Sky& sky, const glm::ivec2& size) {
    std::vector<float> texels;
    for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
            const double azimuth = 2.0 * std::numbers::pi * ((i + 0.5) / size.x - 0.5);
            const double zenith = std::numbers::pi * (j + 0.5) / size.y;
            const double sine = std::sin(zenith);
            const glm::vec3 L(
                sky.radiance({sine * std::sin(azimuth), std::cos(zenith), -sine * std::cos(azimuth)}));
            texels.insert(texels.end(), {L.r, L.g, L.b, 1.0f});
        }
    return texels;
}

}  // namespace

void AmbientPicture::drawSky(const Frame& frame, const AmbientOptions& options) {
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (frame.view != "color") return;
    const glm::ivec2 size(512, 256);
    const std::string key = options.lightKey();
    if (!sky_ || key != skyKey_) {
        sky_.emplace(size, GL_RGBA32F);
        sky_->upload(latLongTexels(options.light(frame.scene).sky, size));
        skyKey_ = key;
    }
    backdrop_.setTexture("uSky", GL_TEXTURE_2D, sky_->id());
    backdrop_.set("uWorldFromClip",
                  glm::mat4(glm::inverse(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y))));
    backdrop_.set("uEye", glm::vec3(frame.camera.position));
    backdrop_.set("uParallel", frame.camera.orthographic);
    backdrop_.set("uForward", glm::vec3(frame.camera.forward));
    backdrop_.prepareToDraw();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
}

void AmbientPicture::begin(Program& program, const Frame& frame, const AmbientOptions& options) {
    drawSky(frame, options);
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
    return {&hemisphere_, &hemisphereUniform_, &pixels_, &stored_, &backdrop_, &shown_};
}

}  // namespace penumbra
