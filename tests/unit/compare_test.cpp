#include "common/image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/error.h"

namespace penumbra {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

FloatImage ramp(int width, int height, int channels) {
    FloatImage image(width, height, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = float(i) / float(image.values.size());
    return image;
}

TEST(Compare, APictureEqualsItself) {
    const ImageError error = compareImages(ramp(7, 5, 3), ramp(7, 5, 3));
    EXPECT_EQ(error.pixels, 35u);
    EXPECT_EQ(error.excluded, 0u);
    EXPECT_EQ(error.rmse, 0.0);
    EXPECT_EQ(error.maxAbs, 0.0);
    EXPECT_TRUE(error.worst.empty());
}

TEST(Compare, AKnownDifferenceGivesTheFiguresOfItsDefinition) {
    FloatImage actual(4, 1, 1), exact(4, 1, 1);
    actual.values = {0.5f, 0.0f, 1.0f, 0.25f};
    exact.values = {0.0f, 0.0f, 0.0f, 0.5f};
    const ImageError error = compareImages(actual, exact);
    EXPECT_DOUBLE_EQ(error.rmse, std::sqrt((0.25 + 1.0 + 0.0625) / 4.0));
    EXPECT_DOUBLE_EQ(error.meanAbs, 1.75 / 4.0);
    EXPECT_DOUBLE_EQ(error.bias, 1.25 / 4.0);
    EXPECT_DOUBLE_EQ(error.maxAbs, 1.0);
    ASSERT_EQ(error.worst.size(), 3u);
    EXPECT_EQ(error.worst[0].x, 2);
    EXPECT_EQ(error.worst[0].actual, 1.0f);
    EXPECT_EQ(error.worst[0].exact, 0.0f);
    EXPECT_EQ(error.worst[2].x, 3);
}

TEST(Compare, AnErrorInOneChannelOfOnePixelIsSeen) {
    FloatImage actual = ramp(16, 16, 3);
    actual.at(11, 13, 2) += 0.5f;
    const ImageError error = compareImages(actual, ramp(16, 16, 3));
    EXPECT_NEAR(error.maxAbs, 0.5, 1e-6);
    EXPECT_NEAR(error.bias, 0.5 / (16 * 16 * 3), 1e-9);
    ASSERT_EQ(error.worst.size(), 1u);
    EXPECT_EQ(error.worst[0].x, 11);
    EXPECT_EQ(error.worst[0].y, 13);
}

TEST(Compare, AShiftByOnePixelIsSeen) {
    FloatImage edge(8, 8, 1), shifted(8, 8, 1);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            edge.at(x, y) = x < 4 ? 0.0f : 1.0f;
            shifted.at(x, y) = x < 5 ? 0.0f : 1.0f;
        }
    const ImageError error = compareImages(shifted, edge);
    EXPECT_DOUBLE_EQ(error.maxAbs, 1.0);
    EXPECT_DOUBLE_EQ(error.meanAbs, 1.0 / 8.0);
    EXPECT_DOUBLE_EQ(error.bias, -1.0 / 8.0);
}

TEST(Compare, WhatIsNotANumberCanNeverPass) {
    for (const float bad : {nan, infinity, -infinity}) {
        FloatImage actual = ramp(5, 5, 1);
        actual.at(2, 3) = bad;
        const ImageError error = compareImages(actual, ramp(5, 5, 1));
        EXPECT_EQ(error.maxAbs, 1e30);
        EXPECT_GT(error.rmse, 1e28);
        ASSERT_FALSE(error.worst.empty());
        EXPECT_EQ(error.worst[0].x, 2);
        EXPECT_EQ(error.worst[0].y, 3);
        EXPECT_EQ(compareImages(ramp(5, 5, 1), actual).maxAbs, 1e30);
        EXPECT_EQ(compareImages(actual, actual).maxAbs, 1e30);  // both infinite is no agreement
    }
}

TEST(Compare, MaskedPixelsAreLeftOutAndCounted) {
    FloatImage actual = ramp(4, 4, 3);
    FloatImage mask(4, 4, 1, 1.0f);
    actual.at(1, 1, 0) = nan;
    mask.at(1, 1) = 0.0f;
    const ImageError error = compareImages(actual, ramp(4, 4, 3), mask);
    EXPECT_EQ(error.pixels, 15u);
    EXPECT_EQ(error.excluded, 1u);
    EXPECT_EQ(error.maxAbs, 0.0);
}

TEST(Compare, AComparisonOfNothingIsAnErrorNotAPass) {
    EXPECT_THROW(compareImages(ramp(4, 4, 1), ramp(4, 4, 1), FloatImage(4, 4, 1, 0.0f)), Error);
    EXPECT_THROW(compareImages(FloatImage(), FloatImage()), Error);
}

TEST(Compare, WhatDoesNotFitIsRefused) {
    EXPECT_THROW(compareImages(ramp(4, 4, 1), ramp(4, 5, 1)), Error);
    EXPECT_THROW(compareImages(ramp(4, 4, 1), ramp(4, 4, 3)), Error);
    EXPECT_THROW(compareImages(ramp(4, 4, 1), ramp(4, 4, 1), FloatImage(5, 4, 1, 1.0f)), Error);
    EXPECT_THROW(compareImages(ramp(4, 4, 1), ramp(4, 4, 1), FloatImage(4, 4, 3, 1.0f)), Error);
}

TEST(Compare, TheTenWorstPixelsAreKeptWorstFirst) {
    FloatImage actual(5, 5, 1);
    for (int i = 0; i < 25; ++i) actual.values[std::size_t(i)] = float((i * 7) % 25);
    const ImageError error = compareImages(actual, FloatImage(5, 5, 1));
    ASSERT_EQ(error.worst.size(), 10u);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(error.worst[i].actual, 24.0f - float(i));
}

TEST(Compare, TheErrorPictureShowsDifferencesAndMarksTheMask) {
    FloatImage actual(3, 1, 1), exact(3, 1, 1), mask(3, 1, 1, 1.0f);
    actual.values = {0.5f, 0.02f, 0.9f};
    exact.values = {0.5f, 0.0f, 0.1f};
    mask.at(2, 0) = 0.0f;
    const FloatImage picture = errorImage(actual, exact, mask, 10.0f);
    ASSERT_EQ(picture.channels, 3);
    EXPECT_EQ(picture.at(0, 0, 0), 0.0f);
    EXPECT_NEAR(picture.at(1, 0, 0), 0.2f, 1e-6);
    EXPECT_NEAR(picture.at(1, 0, 2), 0.2f, 1e-6);
    EXPECT_EQ(picture.at(2, 0, 0), 0.0f);
    EXPECT_GT(picture.at(2, 0, 2), 0.1f);
}

}  // namespace
}  // namespace penumbra
