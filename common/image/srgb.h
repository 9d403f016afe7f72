// The sRGB transfer curve (IEC 61966-2-1), the same for writing and reading.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace penumbra {

/// Linear [0,1] to encoded [0,1].
inline float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// Encoded [0,1] to linear [0,1].
inline float decodeSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Clamped to [0,1], encoded, rounded to the nearest of 256 steps. NaN becomes 0.
inline std::uint8_t srgbByte(float linear) {
    const float inside = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;  // false for NaN
    return std::uint8_t(std::lround(255.0f * encodeSrgb(inside)));
}

}  // namespace penumbra
