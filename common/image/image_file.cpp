#include "common/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

#include "common/error.h"
#include "common/image/file_write.h"
#include "common/image/image_codec.h"
#include "common/image/png_chunks.h"
#include "common/image/srgb.h"

namespace penumbra {
namespace {

constexpr int channelLimit = 64;
constexpr std::size_t pixelLimit = std::size_t(1) << 30;

std::string lowerExtension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

std::string encodePng(const FloatImage& image, const std::string& name) {
    std::vector<std::uint8_t> bytes(image.values.size());
    std::transform(image.values.begin(), image.values.end(), bytes.begin(), srgbByte);
    return imageCodec().encodePng(image.width, image.height, image.channels, bytes.data(), name);
}

void requireReadable(const PictureSize& size, std::size_t maxPixels, const std::string& name) {
    if (size.width < 1 || size.height < 1 || size.depth > 1 || size.channels < 1 ||
        size.channels > channelLimit)
        throw Error(fmt::format("{}: not a picture: {} x {} x {} pixels of {} channels", name, size.width,
                                size.height, size.depth, size.channels));
    if (std::size_t(size.width) * std::size_t(size.height) > maxPixels)
        throw Error(fmt::format("{}: {} x {} pixels is more than the limit of {}; make it smaller", name,
                                size.width, size.height, maxPixels));
}

std::string bytesOfFile(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad())
        throw Error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    return bytes;
}

/// The bytes that a decoder is given: of a PNG only the chunks that matter, of others all.
class Encoded {
 public:
    Encoded(const std::uint8_t* bytes, std::size_t count, const std::string& name)
        : png_(isPng(bytes, count) ? essentialPng(bytes, count, name) : std::vector<std::uint8_t>()),
          data_(png_.empty() ? bytes : png_.data()),
          count_(png_.empty() ? count : png_.size()) {}
    Encoded(const Encoded&) = delete;
    Encoded& operator=(const Encoded&) = delete;

    std::unique_ptr<OpenPicture> open(const std::string& extension, const std::string& name) const {
        return imageCodec().open(data_, count_, extension, name);
    }

 private:
    std::vector<std::uint8_t> png_;
    const std::uint8_t* data_;
    std::size_t count_;
};

void decodeColour(FloatImage& image) {
    const bool hasAlpha = image.channels == 2 || image.channels == 4;
    for (std::size_t i = 0; i < image.values.size(); ++i)
        if (!hasAlpha || int(i % std::size_t(image.channels)) != image.channels - 1)
            image.values[i] = decodeSrgb(image.values[i]);
}

/// Grey, grey + alpha, RGB or RGBA (more: the first four) to RGBA.
void expandToRgba(const std::vector<std::uint8_t>& source, int channels, std::vector<std::uint8_t>& rgba) {
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
        const std::uint8_t* in = &source[i * std::size_t(channels)];
        const bool grey = channels < 3;
        rgba[4 * i + 0] = in[0];
        rgba[4 * i + 1] = in[grey ? 0 : 1];
        rgba[4 * i + 2] = in[grey ? 0 : 2];
        rgba[4 * i + 3] = channels == 2 ? in[1] : channels >= 4 ? in[3] : 255;
    }
}

const char* extensionByMagic(const std::uint8_t* bytes, std::size_t count) {
    if (isPng(bytes, count)) return ".png";
    const bool jpeg = count >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
    return jpeg ? ".jpg" : nullptr;
}

}  // namespace

void writeImage(const std::filesystem::path& file, const FloatImage& image,
                const std::map<std::string, std::string>& metadata) {
    if (image.values.empty()) throw Error(fmt::format("{}: the picture to write is empty", file.string()));
    const std::string extension = lowerExtension(file);
    if (extension == ".exr") return writeFile(file, imageCodec().encodeExr(image, metadata, file.string()));
    if (extension != ".png")
        throw Error(
            fmt::format("{}: unknown picture format \"{}\"; use .png or .exr", file.string(), extension));
    if (image.channels != 1 && image.channels != 3)
        throw Error(fmt::format("{}: a .png takes 1 or 3 channels, not {}", file.string(), image.channels));
    writeFile(file, encodePng(image, file.string()));
}

FloatImage readImage(const std::filesystem::path& file) {
    const std::string bytes = bytesOfFile(file);
    const Encoded encoded(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), file.string());
    const auto picture = encoded.open(lowerExtension(file), file.string());
    const PictureSize size = picture->size();
    requireReadable(size, pixelLimit, file.string());
    FloatImage image(size.width, size.height, size.channels);
    picture->read(image.values.data());
    if (size.srgbEncoded) decodeColour(image);
    return image;
}

DecodedImage decodeImage(const std::uint8_t* bytes, std::size_t count, const std::string& name,
                         std::size_t maxPixels) {
    const char* extension = extensionByMagic(bytes, count);
    if (!extension) throw Error(fmt::format("{}: neither a PNG nor a JPEG picture", name));
    const Encoded encoded(bytes, count, name);
    const auto picture = encoded.open(extension, name);
    const PictureSize size = picture->size();
    requireReadable(size, maxPixels, name);
    DecodedImage image{size.width, size.height, {}};
    const std::size_t pixels = std::size_t(size.width) * std::size_t(size.height);
    std::vector<std::uint8_t> stored(pixels * std::size_t(size.channels));
    picture->read(stored.data());
    image.rgba.resize(4 * pixels);
    expandToRgba(stored, size.channels, image.rgba);
    return image;
}

void writeTextFile(const std::filesystem::path& file, const std::string& text) {
    writeFile(file, text);
}

}  // namespace penumbra
