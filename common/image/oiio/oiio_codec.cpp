// The one file that includes OpenImageIO: a library of its own, see image_codec.h.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/error.h"
#include "common/image/image_codec.h"

namespace penumbra {
namespace {

/// OpenImageIO's messages may have several lines; ours have one.
std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.empty() ? "unknown format" : text;
}

/// Encodes into memory: what reaches the disk is then one write of a finished file.
std::string encode(const char* format, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
                   const void* pixels, const std::string& name) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->set_ioproxy(&memory) || !output->open(format, spec) ||
        !output->write_image(type, pixels) || !output->close()) {
        const std::string why = output ? output->geterror() : OIIO::geterror();
        throw Error(fmt::format("{}: OpenImageIO cannot encode this picture: {}", name, oneLine(why)));
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class OiioPicture : public OpenPicture {
 public:
    OiioPicture(const std::uint8_t* bytes, std::size_t count, const std::string& extension, std::string name)
        : name_(std::move(name)), memory_(const_cast<std::uint8_t*>(bytes), count) {
        OIIO::ImageSpec config;
        // Colour bytes as stored, not multiplied by alpha: the default would darken transparent texels.
        config.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::Filesystem::IOProxy* proxy = &memory_;
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        input_ = OIIO::ImageInput::open("memory" + extension, &config, proxy);
        if (!input_)
            throw Error(fmt::format("{}: not a readable picture: {}", name_, oneLine(OIIO::geterror())));
    }
    OiioPicture(const OiioPicture&) = delete;
    OiioPicture& operator=(const OiioPicture&) = delete;

    PictureSize size() const override {
        const OIIO::ImageSpec& spec = input_->spec();
        const auto type = spec.format.basetype;
        return {spec.width, spec.height, spec.depth, spec.nchannels,
                type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT16};
    }
    void read(float* pixels) override { readAs(OIIO::TypeDesc::FLOAT, pixels); }
    void read(std::uint8_t* pixels) override { readAs(OIIO::TypeDesc::UINT8, pixels); }

 private:
    void readAs(const OIIO::TypeDesc& type, void* pixels) {
        if (!input_->read_image(0, 0, 0, -1, type, pixels))
            throw Error(fmt::format("{}: damaged picture: {}", name_, oneLine(input_->geterror())));
    }

    std::string name_;
    OIIO::Filesystem::IOMemReader memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

class OiioCodec : public ImageCodec {
 public:
    std::unique_ptr<OpenPicture> open(const std::uint8_t* bytes, std::size_t count,
                                      const std::string& extension, const std::string& name) const override {
        return std::make_unique<OiioPicture>(bytes, count, extension, name);
    }

    std::string encodeExr(const FloatImage& image, const std::map<std::string, std::string>& metadata,
                          const std::string& name) const override {
        OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
        spec.attribute("compression", "zip");
        // Without this OpenImageIO writes the time of day, and no two runs would give the same file.
        spec.attribute("DateTime", "");
        for (const auto& [key, value] : metadata) spec.attribute(key, value);
        return encode("memory.exr", spec, OIIO::TypeDesc::FLOAT, image.values.data(), name);
    }

    std::string encodePng(int width, int height, int channels, const std::uint8_t* pixels,
                          const std::string& name) const override {
        OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:ColorSpace", "sRGB");
        return encode("memory.png", spec, OIIO::TypeDesc::UINT8, pixels, name);
    }
};

}  // namespace
}  // namespace penumbra

extern "C" const penumbra::ImageCodec* penumbraImageCodec() {
    static const penumbra::OiioCodec codec;
    return &codec;
}
