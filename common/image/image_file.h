// Reading and writing pictures, through OpenImageIO. Every write goes to a temporary file beside the target
// and is then renamed, so that a kill at any moment leaves either the old file or the new one, never half of
// one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/image/image.h"

namespace penumbra {

/// .exr: linear 32-bit float, exact. .png: 8 bits, sRGB-encoded (1 and 3 channels; values are clamped to
/// [0,1], so tone-map first). Makes missing directories. `metadata` becomes string attributes (.exr) so that
/// references carry their provenance. Throws Error (unwritable, unknown extension, NaN is written as is in
/// .exr).
void writeImage(const std::filesystem::path& file, const FloatImage& image,
                const std::map<std::string, std::string>& metadata = {});

/// Any format OpenImageIO reads; .png is decoded to linear. Throws Error when missing or broken.
FloatImage readImage(const std::filesystem::path& file);

/// Decodes a PNG or JPEG from memory to 8-bit RGBA (sRGB bytes untouched, rows top first). Dimensions are
/// checked before any pixel memory is allocated: more than `maxPixels` is an Error. For textures in glTF
/// files.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};
DecodedImage decodeImage(const std::uint8_t* bytes, std::size_t count, const std::string& name,
                         std::size_t maxPixels = std::size_t(1) << 26);

/// Writes a text file with the same promise (temporary file, then rename); makes directories. Throws Error.
void writeTextFile(const std::filesystem::path& file, const std::string& text);

}  // namespace penumbra
