#include "chapters/09_ambient_occlusion/profile.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace penumbra {

namespace {

constexpr float upperPart = 0.72f;  // of the picture's height, for the curve

/// Heights over the middle row, 0 (lowest) to 1; nothing where no surface is seen.
std::vector<std::optional<double>> heights(const Frame& frame, const PixelRays& pixels) {
    std::vector<std::optional<double>> result(static_cast<std::size_t>(frame.size.x));
    double low = 1e300, high = -1e300;
    for (std::size_t x = 0; x < result.size(); ++x) {
        const Hit& hit = pixels.middleRow()[x];
        if (!hit.valid) continue;
        result[x] = hit.position.y;
        low = std::min(low, hit.position.y);
        high = std::max(high, hit.position.y);
    }
    for (auto& height : result)
        if (height) *height = high > low ? (*height - low) / (high - low) : 1.0;
    return result;
}

}  // namespace

std::vector<float> profilePicture(const Frame& frame, const PixelRays& pixels) {
    const glm::ivec2 size = frame.size;
    const std::vector<std::optional<double>> surface = heights(frame, pixels);
    std::vector<float> picture(4 * std::size_t(size.x) * std::size_t(size.y), 1.0f);
    const int foot = int((1.0f - upperPart) * float(size.y)), unit = int(0.94f * float(size.y - foot));
    for (int x = 0; x < size.x; ++x) {
        const auto& ground = surface[std::size_t(x)];
        const std::size_t pixel = std::size_t(size.y / 2) * std::size_t(size.x) + std::size_t(x);
        const int value = foot + int(std::lround(pixels.visibility(pixel) * float(unit)));
        const int top = ground ? int(*ground * 0.8 * foot) : -1;
        for (int y = 0; y < size.y; ++y) {
            glm::vec3 colour(0.02f);
            if (y < foot) {
                colour = y <= top ? glm::vec3(0.36f, 0.27f, 0.17f) : glm::vec3(0.05f);
            } else if (ground && y <= value) {
                colour = glm::vec3(0.6f);
            } else if ((y - foot) % std::max(1, unit / 4) == 0) {
                colour = glm::vec3(0.15f);
            }
            std::copy_n(&colour.x, 3, &picture[4 * (std::size_t(y) * std::size_t(size.x) + std::size_t(x))]);
        }
    }
    return picture;
}

}  // namespace penumbra
