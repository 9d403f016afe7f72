#include "chapters/09_ambient_occlusion/backdrop.h"

#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

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

void Backdrop::draw(const Frame& frame, const AmbientOptions& options, bool seen) {
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (!seen) return;
    const glm::ivec2 size(512, 256);
    const std::string key = options.lightKey();
    if (!sky_ || key != key_) {
        sky_.emplace(size, GL_RGBA32F);
        sky_->upload(latLongTexels(options.light(frame.scene).sky, size));
        key_ = key;
    }
    program_.setTexture("uSky", GL_TEXTURE_2D, sky_->id());
    program_.set("uWorldFromClip",
                 glm::mat4(glm::inverse(clipFromWorld(frame.camera, double(frame.size.x) / frame.size.y))));
    program_.set("uEye", glm::vec3(frame.camera.position));
    program_.set("uParallel", frame.camera.orthographic);
    program_.set("uForward", glm::vec3(frame.camera.forward));
    program_.prepareToDraw();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
}

}  // namespace penumbra
