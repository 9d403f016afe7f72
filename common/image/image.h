// Linear float pictures: the currency between rendering, truth, comparison and files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// width x height x channels floats, interleaved, linear light, TOP row first.
struct FloatImage {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> values;

    FloatImage() = default;
    FloatImage(int w, int h, int c, float fill = 0.0f)
        : width(w), height(h), channels(c), values(std::size_t(w) * h * c, fill) {}

    float& at(int x, int y, int c = 0) { return values[(std::size_t(y) * width + x) * channels + c]; }
    float at(int x, int y, int c = 0) const { return values[(std::size_t(y) * width + x) * channels + c]; }
    bool sameSizeAs(const FloatImage& other) const { return width == other.width && height == other.height; }
    bool operator==(const FloatImage& other) const = default;
};

}  // namespace penumbra
