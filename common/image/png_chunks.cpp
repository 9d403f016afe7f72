#include "common/image/png_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/error.h"

namespace penumbra {
namespace {

constexpr std::size_t signatureLength = 8;
constexpr std::size_t aroundData = 12;  // bytes of a chunk that are not its data: length, name, checksum
constexpr std::uint8_t signature[signatureLength] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::uint32_t bigEndian(const std::uint8_t* p) {
    return std::uint32_t(p[0]) << 24 | std::uint32_t(p[1]) << 16 | std::uint32_t(p[2]) << 8 | p[3];
}

/// CRC-32 as in the PNG specification, annex D.
std::uint32_t checksum(const std::uint8_t* bytes, std::size_t count) {
    static const auto table = [] {
        std::array<std::uint32_t, 256> entries;
        for (std::uint32_t n = 0; n < 256; ++n) {
            std::uint32_t c = n;
            for (int k = 0; k < 8; ++k) c = (c & 1) ? 0xedb88320u ^ (c >> 1) : c >> 1;
            entries[n] = c;
        }
        return entries;
    }();
    std::uint32_t c = 0xffffffffu;
    for (std::size_t i = 0; i < count; ++i) c = table[(c ^ bytes[i]) & 0xff] ^ (c >> 8);
    return ~c;
}

bool isEssential(const std::uint8_t* name) {
    static constexpr std::array<const char*, 5> kept{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
    return std::any_of(kept.begin(), kept.end(),
                       [&](const char* one) { return std::memcmp(name, one, 4) == 0; });
}

}  // namespace

bool isPng(const std::uint8_t* bytes, std::size_t count) {
    return count >= signatureLength && std::equal(signature, signature + signatureLength, bytes);
}

std::vector<std::uint8_t> essentialPng(const std::uint8_t* bytes, std::size_t count,
                                       const std::string& name) {
    if (!isPng(bytes, count)) throw Error(fmt::format("{}: not a PNG picture", name));
    std::vector<std::uint8_t> kept(bytes, bytes + signatureLength);
    for (std::size_t at = signatureLength; at + aroundData <= count;) {
        const std::uint8_t* chunk = bytes + at;
        const std::size_t length = bigEndian(chunk);
        if (length > count - at - aroundData) break;
        const std::uint8_t* type = chunk + 4;
        if (checksum(type, length + 4) != bigEndian(type + 4 + length))
            throw Error(fmt::format("{}: damaged PNG picture: wrong checksum at byte {}", name, at));
        if (isEssential(type)) kept.insert(kept.end(), chunk, chunk + length + aroundData);
        if (std::memcmp(type, "IEND", 4) == 0) return kept;
        at += length + aroundData;
    }
    throw Error(
        fmt::format("{}: damaged PNG picture: it ends after {} bytes, before its last chunk", name, count));
}

}  // namespace penumbra
