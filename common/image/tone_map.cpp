#include "common/image/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"

namespace penumbra {
namespace {

const glm::vec3 mustBeSeen{1.0f, 0.0f, 1.0f};

/// The highlight compression of Khronos' PBR neutral tone mapper (2024), without its Fresnel offset: the
/// identity up to `start`, then a rational curve towards 1 that joins with equal slope; what is far above
/// white fades to it gradually.
glm::vec3 compressHighlights(glm::vec3 colour) {
    constexpr float start = 0.8f;
    constexpr float room = 1.0f - start;
    constexpr float desaturation = 0.15f;
    const float peak = std::max({colour.r, colour.g, colour.b});
    if (peak <= start) return colour;
    if (std::isinf(peak)) return glm::vec3(1.0f);
    const float newPeak = 1.0f - room * room / (peak + room - start);
    colour *= newPeak / peak;
    const float towardsWhite = 1.0f - 1.0f / (desaturation * (peak - newPeak) + 1.0f);
    return glm::mix(colour, glm::vec3(newPeak), towardsWhite);
}

/// The colour map at t in [0,1], linear sRGB. In Oklab (B. Ottosson, "A perceptual color space", 2020) its
/// lightness is linear in t, so equal steps of the value look like equal steps; its hue turns from blue over
/// teal and green to yellow.
glm::vec3 mapColour(double t) {
    const double lightness = 0.22 + 0.73 * t;
    const double hue = 4.75 - 2.85 * t;                     // radians: blue .. yellow
    const double chroma = 0.095 - 0.1 * t + 0.185 * t * t;  // stays inside the sRGB gamut
    const double a = chroma * std::cos(hue);
    const double b = chroma * std::sin(hue);
    const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    const glm::dvec3 linear{4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    return glm::clamp(linear, 0.0, 1.0);
}

constexpr int mapSteps = 1024;

const std::array<glm::vec3, mapSteps + 1>& mapTable() {
    static const auto table = [] {
        std::array<glm::vec3, mapSteps + 1> colours;
        for (int i = 0; i <= mapSteps; ++i) colours[std::size_t(i)] = mapColour(double(i) / mapSteps);
        return colours;
    }();
    return table;
}

void store(FloatImage& image, std::size_t pixel, const glm::vec3& colour) {
    for (int c = 0; c < 3; ++c) image.values[3 * pixel + std::size_t(c)] = colour[c];
}

}  // namespace

FloatImage toneMap(const FloatImage& image, float exposure) {
    if (image.channels != 1 && image.channels != 3) throw Error("tone mapping takes 1 or 3 channels");
    FloatImage result = image;
    if (image.channels == 1) {
        for (float& v : result.values) v = v * exposure > 0.0f ? std::min(v * exposure, 1.0f) : 0.0f;
        return result;
    }
    for (std::size_t i = 0; i < image.values.size() / 3; ++i) {
        const float* v = &image.values[3 * i];
        const glm::vec3 scaled = glm::vec3(v[0], v[1], v[2]) * exposure;
        const bool bad = std::isnan(scaled.r) || std::isnan(scaled.g) || std::isnan(scaled.b);
        store(result, i, bad ? mustBeSeen : compressHighlights(glm::max(scaled, glm::vec3(0.0f))));
    }
    return result;
}

FloatImage falseColour(const FloatImage& image, float low, float high) {
    if (image.channels != 1) throw Error("false colour takes 1 channel");
    FloatImage result(image.width, image.height, 3);
    const float range = high > low ? high - low : 1.0f;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const float t = (image.values[i] - low) / range;
        const bool bad = std::isnan(t);
        const int step = bad ? 0 : int(std::lround(glm::clamp(t, 0.0f, 1.0f) * mapSteps));
        store(result, i, bad ? mustBeSeen : mapTable()[std::size_t(step)]);
    }
    return result;
}

}  // namespace penumbra
