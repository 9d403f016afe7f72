// Files, tone mapping, false colour, making smaller.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <functional>
#include <limits>

#include "common/error.h"
#include "common/image/file_write.h"
#include "common/image/image_file.h"
#include "common/image/png_chunks.h"
#include "common/image/resample.h"
#include "common/image/srgb.h"
#include "common/image/tone_map.h"
#include "tests/unit/png_chunk.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

FloatImage gradient(int width, int height, int channels, float scale) {
    FloatImage image(width, height, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = scale * float(i) / float(image.values.size());
    return image;
}

std::string messageOf(const std::function<void()>& work) {
    try {
        work();
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(ImageFile, ExrKeepsEveryBitOfEveryChannelCount) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3, 4}) {
        FloatImage image = gradient(33, 17, channels, 1e4f);
        image.values[5] = -1e-30f;
        image.values[6] = infinity;
        writeImage(folder / "a.exr", image);
        EXPECT_EQ(readImage(folder / "a.exr"), image) << channels;
    }
    FloatImage withNan(1, 1, 1, nan);
    writeImage(folder / "nan.exr", withNan);
    EXPECT_TRUE(std::isnan(readImage(folder / "nan.exr").at(0, 0)));
}

TEST(ImageFile, PngIsSrgbAndComesBackLinearToHalfAStep) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3}) {
        const FloatImage image = gradient(64, 16, channels, 1.0f);
        writeImage(folder / "a.png", image);
        const FloatImage back = readImage(folder / "a.png");
        ASSERT_TRUE(back.sameSizeAs(image));
        ASSERT_EQ(back.channels, channels);
        for (std::size_t i = 0; i < image.values.size(); ++i)
            EXPECT_NEAR(encodeSrgb(back.values[i]), encodeSrgb(image.values[i]), 0.5 / 255.0 + 1e-6);
    }
}

TEST(ImageFile, PngClampsAndNeverWraps) {
    const TemporaryFolder folder;
    FloatImage image(4, 1, 1);
    image.values = {-1.0f, 2.0f, infinity, nan};
    writeImage(folder / "a.png", image);
    EXPECT_EQ(readImage(folder / "a.png").values, (std::vector<float>{0.0f, 1.0f, 1.0f, 0.0f}));
}

TEST(ImageFile, TheFirstRowIsTheTopOne) {
    const TemporaryFolder folder;
    FloatImage image(1, 3, 1);
    image.values = {1.0f, 0.5f, 0.0f};
    for (const char* name : {"a.png", "a.exr"}) {
        writeImage(folder / name, image);
        EXPECT_GT(readImage(folder / name).at(0, 0), 0.9f) << name;
    }
}

/// As metadata would begin: "2026:".
std::string yearNow() {
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y:", std::gmtime(&now));
    return text;
}

TEST(ImageFile, TwoWritesGiveIdenticalFiles) {
    const TemporaryFolder folder;
    const FloatImage image = gradient(40, 30, 3, 1.0f);
    for (const char* extension : {".png", ".exr"}) {
        writeImage(folder / (std::string("a") + extension), image, {{"penumbra:seed", "1"}});
        writeImage(folder / (std::string("b") + extension), image, {{"penumbra:seed", "1"}});
        const std::string first = bytesOf(folder / (std::string("a") + extension));
        ASSERT_GT(first.size(), 100u);
        EXPECT_TRUE(first == bytesOf(folder / (std::string("b") + extension))) << extension;
        EXPECT_EQ(first.find(yearNow()), std::string::npos) << extension << " carries the time of its making";
    }
}

TEST(ImageFile, MistakesAreOneClearLine) {
    const TemporaryFolder folder;
    const FloatImage image(2, 2, 3);
    EXPECT_NE(messageOf([&] { writeImage(folder / "a.jpg", image); }).find("use .png or .exr"),
              std::string::npos);
    EXPECT_NE(messageOf([&] { writeImage(folder / "a.png", FloatImage(2, 2, 2)); }).find("1 or 3"),
              std::string::npos);
    EXPECT_NE(messageOf([&] { writeImage(folder / "a.png", FloatImage()); }).find("is empty"),
              std::string::npos);
    EXPECT_NE(messageOf([&] { readImage(folder / "missing.png"); }), "");
    writeTextFile(folder / "fake.png", "this is no picture");
    const std::string broken = messageOf([&] { readImage(folder / "fake.png"); });
    EXPECT_NE(broken.find("fake.png"), std::string::npos);
    EXPECT_EQ(broken.find('\n'), std::string::npos);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(ImageFile, ATruncatedFileIsRefusedNotCrashedOn) {
    const TemporaryFolder folder;
    writeImage(folder / "whole.png", gradient(64, 64, 3, 1.0f));
    const std::string whole = bytesOf(folder / "whole.png");
    for (const std::size_t length : {0ul, 8ul, 30ul, whole.size() / 2}) {
        writeTextFile(folder / "cut.png", whole.substr(0, length));
        EXPECT_THROW(readImage(folder / "cut.png"), Error) << length;
    }
    writeImage(folder / "whole.exr", gradient(64, 64, 3, 1.0f));
    const std::string exr = bytesOf(folder / "whole.exr");
    for (const std::size_t length : {30ul, exr.size() / 2, exr.size() - 10}) {
        writeTextFile(folder / "cut.exr", exr.substr(0, length));
        EXPECT_THROW(readImage(folder / "cut.exr"), Error) << length;
    }
}

TEST(DecodeImage, BytesAreUntouchedAndAlphaIsWhole) {
    const TemporaryFolder folder;
    writeImage(folder / "grey.png", gradient(16, 16, 1, 1.0f));
    const std::string bytes = bytesOf(folder / "grey.png");
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const DecodedImage image = decodeImage(data, bytes.size(), "grey");
    ASSERT_EQ(image.rgba.size(), 16u * 16u * 4u);
    EXPECT_EQ(image.rgba[4 * 200 + 0], srgbByte(200.0f / 256.0f));
    EXPECT_EQ(image.rgba[4 * 200 + 2], srgbByte(200.0f / 256.0f));
    EXPECT_EQ(image.rgba[4 * 200 + 3], 255);
    EXPECT_THROW(decodeImage(data, bytes.size(), "grey", 255), Error);
    EXPECT_THROW(decodeImage(data, bytes.size() / 2, "grey"), Error);
    EXPECT_THROW(decodeImage(data, 0, "grey"), Error);
    const std::string text = "GIF89a no picture";
    const std::string gif = messageOf(
        [&] { decodeImage(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), "text"); });
    EXPECT_EQ(gif, "text: neither a PNG nor a JPEG picture");
}

/// What another program would have written: `format` is "png" or "jpeg".
std::string encodedByOthers(const char* format, int channels, const std::vector<std::uint8_t>& pixels,
                            int width) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    auto output = OIIO::ImageOutput::create(format);
    OIIO::ImageSpec spec(width, int(pixels.size()) / width / channels, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("ImageDescription", "a text chunk that nobody needs");
    output->set_ioproxy(&memory);
    output->open(std::string("memory.") + format, spec);
    output->write_image(OIIO::TypeDesc::UINT8, pixels.data());
    output->close();
    return {bytes.begin(), bytes.end()};
}

TEST(DecodeImage, ColourUnderTransparentAlphaIsKept) {
    const std::string bytes = encodedByOthers("png", 4, {200, 100, 50, 0, 10, 20, 30, 128}, 2);
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    EXPECT_EQ(decodeImage(data, bytes.size(), "rgba").rgba,
              (std::vector<std::uint8_t>{200, 100, 50, 0, 10, 20, 30, 128}));
}

TEST(DecodeImage, ReadsJpegAndRefusesHalfOfOne) {
    const std::string bytes = encodedByOthers("jpeg", 3, std::vector<std::uint8_t>(32 * 32 * 3, 128), 32);
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const DecodedImage image = decodeImage(data, bytes.size(), "jpeg");
    EXPECT_EQ(image.width, 32);
    EXPECT_NEAR(image.rgba[0], 128, 2);
    EXPECT_THROW(decodeImage(data, 20, "jpeg"), Error);
}

TEST(DecodeImage, OnlyWhatMakesThePictureReachesTheDecoder) {
    std::string file = "\x89PNG\r\n\x1a\n", expected = file;
    for (const char* name :
         {"IHDR", "iCCP", "PLTE", "tRNS", "zTXt", "IDAT", "tEXt", "IDAT", "tIME", "IEND"}) {
        const std::string made = pngChunk(name, std::string("data of ") + name);
        file += made;
        const bool needed = std::isupper(name[0]) || std::strcmp(name, "tRNS") == 0;  // upper case: critical
        if (needed) expected += made;
    }
    const auto kept = essentialPng(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), "a.png");
    EXPECT_EQ(std::string(kept.begin(), kept.end()), expected);
}

TEST(DecodeImage, ADamagedPngIsNamedBeforeItReachesTheDecoder) {
    const std::string good = encodedByOthers("png", 3, std::vector<std::uint8_t>(8 * 8 * 3, 7), 8);
    for (std::size_t i = 8; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = char(bad[i] ^ 0x55);
        const auto* data = reinterpret_cast<const std::uint8_t*>(bad.data());
        const std::string message = messageOf([&] { decodeImage(data, bad.size(), "a.png"); });
        EXPECT_EQ(message.rfind("a.png: damaged PNG", 0), 0u) << "byte " << i << ": " << message;
    }
}

TEST(WriteFile, MakesFoldersReplacesWholeFilesAndLeavesNothingElse) {
    const TemporaryFolder folder;
    writeFile(folder / "new/folder/a.txt", "one");
    writeFile(folder / "new/folder/a.txt", "two");
    EXPECT_EQ(bytesOf(folder / "new/folder/a.txt"), "two");
    EXPECT_EQ(folder.entries(), 3u);
    struct stat status {};
    ASSERT_EQ(::stat((folder / "new/folder/a.txt").c_str(), &status), 0);
    EXPECT_NE(status.st_mode & 0444, 0400u) << "others should be able to read what any program writes";
}

TEST(WriteFile, ALinkStaysALinkAndADeviceStaysADevice) {
    const TemporaryFolder folder;
    writeFile(folder / "target", "old");
    std::filesystem::create_symlink(folder / "target", folder / "link");
    writeFile(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(bytesOf(folder / "target"), "new");
    writeFile("/dev/null", "gone");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteFile, SaysWhyItCannot) {
    const TemporaryFolder folder;
    EXPECT_NE(messageOf([] { writeFile("/dev/full", "x"); }).find("No space left"), std::string::npos);
    EXPECT_NE(messageOf([&] { writeFile(folder.path(), "x"); }).find("is a folder"), std::string::npos);
    writeFile(folder / "file", "x");
    EXPECT_NE(messageOf([&] { writeFile(folder / "file/below", "x"); }), "");
    EXPECT_NE(messageOf([&] { writeFile("/proc/penumbra/a.png", "x"); }), "");
    EXPECT_NE(messageOf([&] { requireWritable("/proc/penumbra.png"); }), "");
    requireWritable(folder / "later.png");
    EXPECT_EQ(folder.entries(), 1u);
    EXPECT_EQ(bytesOf(folder / "file"), "x");
}

TEST(WriteFile, RemovesWhatAKilledWriteLeftAndNothingElse) {
    const TemporaryFolder folder;
    const int held = ::open((folder / "a.png.part-writes").c_str(), O_CREAT | O_RDWR, 0600);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    for (const char* name : {"a.png.part-killed", "b.png.part-killed", "a.png.part-longer.png", "a.png.old"})
        writeTextFile(folder / name, "half");
    writeFile(folder / "a.png", "new");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png.part-killed"));
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png.part-writes")) << "another program is writing it";
    EXPECT_EQ(folder.entries(), 5u);
    ::close(held);
}

TEST(ToneMap, IsTheIdentityBelowTheKneeAndStaysInRangeAbove) {
    FloatImage image(5, 1, 3);
    image.values = {0.1f, 0.2f,   0.3f, 0.8f, 0.0f,     0.4f, 1.0f, 1.0f,
                    1.0f, 100.0f, 1.0f, 0.0f, infinity, 0.0f, 0.0f};
    const FloatImage mapped = toneMap(image, 1.0f);
    for (int i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(mapped.values[std::size_t(i)], image.values[std::size_t(i)]);
    for (const float v : mapped.values) {
        EXPECT_GE(v, 0.0f);
        EXPECT_LE(v, 1.0f);
    }
    EXPECT_GT(mapped.at(2, 0), 0.85f);
    EXPECT_EQ(mapped.at(4, 0, 1), 1.0f);
    EXPECT_FLOAT_EQ(toneMap(image, 2.0f).at(0, 0, 1), 0.4f);
}

TEST(ToneMap, BrighterInIsBrighterOutAndHueFadesGradually) {
    float last = 0.0f;
    float lastGreen = 0.0f;
    for (int i = 0; i <= 400; ++i) {
        FloatImage red(1, 1, 3);
        red.values = {0.02f * float(i), 0.002f * float(i), 0.0f};
        const FloatImage mapped = toneMap(red, 1.0f);
        EXPECT_GE(mapped.at(0, 0, 0), last);
        EXPECT_LT(mapped.at(0, 0, 1) - lastGreen, 0.02f) << "a jump towards white at " << i;
        last = mapped.at(0, 0, 0);
        lastGreen = mapped.at(0, 0, 1);
    }
    EXPECT_LT(last, 1.0f);
}

TEST(ToneMap, NanIsMagentaAndNegativeIsBlack) {
    FloatImage image(2, 1, 3);
    image.values = {nan, 0.5f, 0.5f, -1.0f, 0.5f, 0.5f};
    const FloatImage mapped = toneMap(image, 1.0f);
    EXPECT_EQ(mapped.at(0, 0, 0), 1.0f);
    EXPECT_EQ(mapped.at(0, 0, 1), 0.0f);
    EXPECT_EQ(mapped.at(0, 0, 2), 1.0f);
    EXPECT_EQ(mapped.at(1, 0, 0), 0.0f);
}

/// CIE 1976 lightness, 0..100, of linear sRGB.
double lightness(const FloatImage& image, int x) {
    const double y = 0.2126 * image.at(x, 0, 0) + 0.7152 * image.at(x, 0, 1) + 0.0722 * image.at(x, 0, 2);
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

TEST(FalseColour, LightnessRisesInEqualStepsFromDarkBlueToYellow) {
    FloatImage values(201, 1, 1);
    for (int i = 0; i <= 200; ++i) values.at(i, 0) = 2.0f + 0.02f * float(i);
    const FloatImage colours = falseColour(values, 2.0f, 6.0f);
    const double mean = (lightness(colours, 200) - lightness(colours, 0)) / 200.0;
    EXPECT_GT(mean, 0.4);
    for (int i = 0; i < 200; ++i) {
        const double step = lightness(colours, i + 1) - lightness(colours, i);
        EXPECT_GT(step, 0.5 * mean) << i;
        EXPECT_LT(step, 1.5 * mean) << i;
    }
    EXPECT_GT(colours.at(0, 0, 2), 3.0f * colours.at(0, 0, 0));
    EXPECT_GT(colours.at(200, 0, 0), 3.0f * colours.at(200, 0, 2));
    EXPECT_GT(colours.at(200, 0, 1), 3.0f * colours.at(200, 0, 2));
}

TEST(FalseColour, ClampsOutsideTheRangeAndShowsNan) {
    FloatImage values(5, 1, 1);
    values.values = {-5.0f, 0.0f, 1.0f, infinity, nan};
    const FloatImage colours = falseColour(values, 0.0f, 1.0f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(colours.at(0, 0, c), colours.at(1, 0, c));
        EXPECT_EQ(colours.at(2, 0, c), colours.at(3, 0, c));
    }
    EXPECT_EQ(colours.at(4, 0, 0), 1.0f);
    EXPECT_EQ(colours.at(4, 0, 1), 0.0f);
    const FloatImage flat = falseColour(FloatImage(1, 1, 1, 3.0f), 3.0f, 3.0f);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(flat.at(0, 0, c), colours.at(0, 0, c)) << "one value is no NaN";
}

TEST(BoxFilter, IsTheMeanOfEachBlock) {
    FloatImage image(4, 2, 1);
    image.values = {1, 2, 5, 6, 3, 4, 7, 8};
    EXPECT_EQ(boxFilter(image, 2).values, (std::vector<float>{2.5f, 6.5f}));
    EXPECT_EQ(boxFilter(image, 1), image);
    EXPECT_THROW(boxFilter(image, 3), Error);
}

}  // namespace
}  // namespace penumbra
