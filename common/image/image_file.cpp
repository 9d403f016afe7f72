#include "common/image/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
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

/// OpenImageIO's messages may have several lines; ours have one.
std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.empty() ? "unknown format" : text;
}

OIIO::ImageSpec specOf(const FloatImage& image, const OIIO::TypeDesc& type) {
    return OIIO::ImageSpec(image.width, image.height, image.channels, type);
}

/// Encodes into memory: what reaches the disk is then one write of a finished file.
std::string encode(const char* format, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
                   const void* pixels, const std::filesystem::path& file) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->set_ioproxy(&memory) || !output->open(format, spec) ||
        !output->write_image(type, pixels) || !output->close()) {
        const std::string why = output ? output->geterror() : OIIO::geterror();
        throw Error(
            fmt::format("{}: OpenImageIO cannot encode this picture: {}", file.string(), oneLine(why)));
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string encodeExr(const FloatImage& image, const std::map<std::string, std::string>& metadata,
                      const std::filesystem::path& file) {
    OIIO::ImageSpec spec = specOf(image, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    // Without this OpenImageIO writes the time of day, and no two runs would give the same file.
    spec.attribute("DateTime", "");
    for (const auto& [name, value] : metadata) spec.attribute(name, value);
    return encode("memory.exr", spec, OIIO::TypeDesc::FLOAT, image.values.data(), file);
}

std::string encodePng(const FloatImage& image, const std::filesystem::path& file) {
    std::vector<std::uint8_t> bytes(image.values.size());
    std::transform(image.values.begin(), image.values.end(), bytes.begin(), srgbByte);
    OIIO::ImageSpec spec = specOf(image, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return encode("memory.png", spec, OIIO::TypeDesc::UINT8, bytes.data(), file);
}

void requireReadable(const OIIO::ImageSpec& spec, std::size_t maxPixels, const std::string& name) {
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 ||
        spec.nchannels > channelLimit)
        throw Error(fmt::format("{}: not a picture: {} x {} x {} pixels of {} channels", name, spec.width,
                                spec.height, spec.depth, spec.nchannels));
    if (std::size_t(spec.width) * std::size_t(spec.height) > maxPixels)
        throw Error(fmt::format("{}: {} x {} pixels is more than the limit of {}; make it smaller", name,
                                spec.width, spec.height, maxPixels));
}

std::string bytesOfFile(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad())
        throw Error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    return bytes;
}

/// An encoded picture in memory, opened: its size is known, its pixels are not unpacked yet.
class OpenPicture {
 public:
    OpenPicture(const std::uint8_t* bytes, std::size_t count, const std::string& extension, std::string name)
        : name_(std::move(name)),
          png_(isPng(bytes, count) ? essentialPng(bytes, count, name_) : std::vector<std::uint8_t>()),
          memory_(png_.empty() ? const_cast<std::uint8_t*>(bytes) : png_.data(),
                  png_.empty() ? count : png_.size()) {
        OIIO::ImageSpec config;
        // Colour bytes as stored, not multiplied by alpha: the default would darken transparent texels.
        config.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::Filesystem::IOProxy* proxy = &memory_;
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        input_ = OIIO::ImageInput::open("memory" + extension, &config, proxy);
        if (!input_)
            throw Error(fmt::format("{}: not a readable picture: {}", name_, oneLine(OIIO::geterror())));
    }
    OpenPicture(const OpenPicture&) = delete;
    OpenPicture& operator=(const OpenPicture&) = delete;

    const OIIO::ImageSpec& spec() const { return input_->spec(); }
    void readInto(const OIIO::TypeDesc& type, void* pixels) {
        if (!input_->read_image(0, 0, 0, -1, type, pixels))
            throw Error(fmt::format("{}: damaged picture: {}", name_, oneLine(input_->geterror())));
    }

 private:
    std::string name_;
    std::vector<std::uint8_t> png_;
    OIIO::Filesystem::IOMemReader memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

bool isSrgbEncoded(const OIIO::ImageSpec& spec) {
    return spec.format.basetype == OIIO::TypeDesc::UINT8 || spec.format.basetype == OIIO::TypeDesc::UINT16;
}

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
    if (extension == ".exr") return writeFile(file, encodeExr(image, metadata, file));
    if (extension != ".png")
        throw Error(
            fmt::format("{}: unknown picture format \"{}\"; use .png or .exr", file.string(), extension));
    if (image.channels != 1 && image.channels != 3)
        throw Error(fmt::format("{}: a .png takes 1 or 3 channels, not {}", file.string(), image.channels));
    writeFile(file, encodePng(image, file));
}

FloatImage readImage(const std::filesystem::path& file) {
    const std::string bytes = bytesOfFile(file);
    OpenPicture picture(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                        lowerExtension(file), file.string());
    requireReadable(picture.spec(), pixelLimit, file.string());
    FloatImage image(picture.spec().width, picture.spec().height, picture.spec().nchannels);
    picture.readInto(OIIO::TypeDesc::FLOAT, image.values.data());
    if (isSrgbEncoded(picture.spec())) decodeColour(image);
    return image;
}

DecodedImage decodeImage(const std::uint8_t* bytes, std::size_t count, const std::string& name,
                         std::size_t maxPixels) {
    const char* extension = extensionByMagic(bytes, count);
    if (!extension) throw Error(fmt::format("{}: neither a PNG nor a JPEG picture", name));
    OpenPicture picture(bytes, count, extension, name);
    const OIIO::ImageSpec& spec = picture.spec();
    requireReadable(spec, maxPixels, name);
    DecodedImage image{spec.width, spec.height, {}};
    const std::size_t pixels = std::size_t(spec.width) * std::size_t(spec.height);
    std::vector<std::uint8_t> stored(pixels * std::size_t(spec.nchannels));
    picture.readInto(OIIO::TypeDesc::UINT8, stored.data());
    image.rgba.resize(4 * pixels);
    expandToRgba(stored, spec.nchannels, image.rgba);
    return image;
}

void writeTextFile(const std::filesystem::path& file, const std::string& text) {
    writeFile(file, text);
}

}  // namespace penumbra
