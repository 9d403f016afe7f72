// What of a PNG file is worth decoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace penumbra {

bool isPng(const std::uint8_t* bytes, std::size_t count);

/// The same picture with the chunks IHDR, PLTE, tRNS, IDAT and IEND only, each checked against its checksum.
/// Colour profiles, texts and times cannot change our pixels, but libpng warns about them on standard error,
/// where nobody asked, and they may unpack to any size. Throws Error naming `name` when the file is cut short
/// or damaged.
std::vector<std::uint8_t> essentialPng(const std::uint8_t* bytes, std::size_t count, const std::string& name);

}  // namespace penumbra
