// OpenImageIO behind a door that is opened when the first picture is read or written; private to
// common/image.
//
// OpenImageIO brings two hundred and fifty libraries, and loading them takes 0.17 s. Linked in, every program
// would pay that before its first line, `--help` and most tests too; so it sits in a library of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "common/image/image.h"

namespace penumbra {

/// What an encoded picture says of itself, before its pixels are unpacked.
struct PictureSize {
    int width = 0, height = 0, depth = 1, channels = 0;
    bool srgbEncoded = false;  ///< 8 or 16 bits, not floats
};

/// An encoded picture in memory, opened: its size is known, its pixels are not unpacked yet.
class OpenPicture {
 public:
    virtual ~OpenPicture() = default;
    virtual PictureSize size() const = 0;
    /// All channels of all pixels, rows top first, as stored (not multiplied by alpha). `pixels` must be
    /// large enough. Throws Error when the picture is damaged.
    virtual void read(float* pixels) = 0;
    virtual void read(std::uint8_t* pixels) = 0;
};

class ImageCodec {
 public:
    virtual ~ImageCodec() = default;
    /// `extension` (".png") is the format to try first; `name` is for messages. `bytes` must outlive the
    /// picture.
    virtual std::unique_ptr<OpenPicture> open(const std::uint8_t* bytes, std::size_t count,
                                              const std::string& extension,
                                              const std::string& name) const = 0;
    /// Floats as they are; `metadata` become string attributes.
    virtual std::string encodeExr(const FloatImage& image, const std::map<std::string, std::string>& metadata,
                                  const std::string& name) const = 0;
    /// Bytes as they are (sRGB), rows top first.
    virtual std::string encodePng(int width, int height, int channels, const std::uint8_t* pixels,
                                  const std::string& name) const = 0;
};

/// Loads OpenImageIO when it is called first. Throws Error when the library is not where the build put it;
/// the environment variable PENUMBRA_IMAGE_CODEC names another.
const ImageCodec& imageCodec();

}  // namespace penumbra
