// Chunks of PNG files, made by hand: to say what no encoder would.
#pragma once

#include <cstdint>
#include <string>

namespace penumbra {

inline std::string bigEndian(std::uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

/// CRC-32 as in the PNG specification, bit by bit.
inline std::uint32_t pngChecksum(const std::string& bytes) {
    std::uint32_t c = ~0u;
    for (const char byte : bytes) {
        c ^= std::uint8_t(byte);
        for (int k = 0; k < 8; ++k) c = c >> 1 ^ (c & 1 ? 0xedb88320u : 0u);
    }
    return ~c;
}

/// Length, name (4 characters), data and checksum.
inline std::string pngChunk(const std::string& name, const std::string& data) {
    return bigEndian(std::uint32_t(data.size())) + name + data + bigEndian(pngChecksum(name + data));
}

}  // namespace penumbra
