// expectImage: what it lets pass, what it fails, and what it leaves behind.
#include "tests/image/image_check.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/image/image_file.h"

namespace penumbra {
namespace {

class ImageCheck : public testing::Test {
 protected:
    // A folder of its own for each test: ctest runs several at once.
    ImageCheck()
        : folder_(std::filesystem::temp_directory_path() / "penumbra_image_check" /
                  testing::UnitTest::GetInstance()->current_test_info()->name()) {
        std::filesystem::remove_all(folder_);
        setenv("PENUMBRA_TEST_OUTPUT", folder_.c_str(), 1);
        exact.at(2, 1) = 0.5f;
        actual = exact;
    }
    ~ImageCheck() override {
        unsetenv("PENUMBRA_TEST_OUTPUT");
        std::filesystem::remove_all(folder_);
    }
    bool left(const char* file) const { return std::filesystem::exists(folder_ / "a/b" / file); }
    nlohmann::json record() const {
        std::ifstream file(folder_ / "a/b/record.json");
        return nlohmann::json::parse(file);
    }

    FloatImage exact{4, 3, 1};
    FloatImage actual;

 private:
    std::filesystem::path folder_;
};

ImageBounds atMost(double maxAbs) {
    ImageBounds bounds;
    bounds.maxAbs = maxAbs;
    return bounds;
}

/// Every failure that `statement` raises, as text; none: "". They do not count as failures of the running
/// test.
template <class Statement>
std::string failuresOf(const Statement& statement) {
    testing::TestPartResultArray results;
    {
        testing::ScopedFakeTestPartResultReporter reporter(
            testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
        statement();
    }
    std::string text;
    for (int i = 0; i < results.size(); ++i) text += results.GetTestPartResult(i).message();
    return text;
}

TEST_F(ImageCheck, RecordsWhatPasses) {
    actual.at(0, 0) = 0.25f;
    const ImageError error = expectImage("a/b", actual, exact, {}, atMost(0.25));
    EXPECT_EQ(error.maxAbs, 0.25);
    EXPECT_TRUE(record()["passed"]);
    EXPECT_EQ(record()["test"], "ImageCheck.RecordsWhatPasses");
    EXPECT_EQ(record()["bounds"][0]["measured"], 0.25);
    EXPECT_FALSE(left("actual.png"));
}

TEST_F(ImageCheck, ExplainsWhatFails) {
    actual.at(2, 1) = 0.75f;
    const std::string said = failuresOf([&] { expectImage("a/b", actual, exact, {}, atMost(0.2)); });
    EXPECT_NE(said.find("max_abs 0.25, allowed 0.2   <-- broken"), std::string::npos) << said;
    EXPECT_NE(said.find("(2, 1): actual 0.75, exact 0.5"), std::string::npos) << said;
    EXPECT_FALSE(record()["passed"]);
    EXPECT_EQ(record()["worst"][0]["exact"], 0.5);
    EXPECT_TRUE(left("actual.png") && left("exact.png") && left("error.png"));
    EXPECT_EQ(readImage(std::string(std::getenv("PENUMBRA_TEST_OUTPUT")) + "/a/b/actual.exr"), actual);
}

TEST_F(ImageCheck, ForgetsTheFailureOfAnEarlierRun) {
    actual.at(2, 1) = 0.75f;
    EXPECT_NE(failuresOf([&] { expectImage("a/b", actual, exact, {}, atMost(0.2)); }), "");
    expectImage("a/b", actual, exact, {}, atMost(0.3));
    EXPECT_TRUE(record()["passed"]);
    EXPECT_FALSE(left("actual.png"));
}

TEST_F(ImageCheck, FailsEachBoundOnItsOwn) {
    for (float& value : actual.values) value += 0.25f;
    for (double ImageBounds::*bound :
         {&ImageBounds::rmse, &ImageBounds::meanAbs, &ImageBounds::maxAbs, &ImageBounds::absBias}) {
        ImageBounds bounds;
        bounds.*bound = 0.26;
        EXPECT_EQ(failuresOf([&] { expectImage("a/b", actual, exact, {}, bounds); }), "");
        bounds.*bound = 0.24;
        EXPECT_NE(failuresOf([&] { expectImage("a/b", actual, exact, {}, bounds); }), "");
    }
}

TEST_F(ImageCheck, FailsWhenTooMuchIsLeftOut) {
    FloatImage mask(4, 3, 1);
    mask.at(2, 1) = 1.0f;
    EXPECT_NE(failuresOf([&] { expectImage("a/b", actual, exact, mask, atMost(0.1)); }), "");
    ImageBounds bounds = atMost(0.1);
    bounds.excludedShare = 0.95;
    EXPECT_EQ(failuresOf([&] { expectImage("a/b", actual, exact, mask, bounds); }), "");
    mask.at(2, 1) = 0.0f;
    EXPECT_NE(failuresOf([&] { expectImage("a/b", actual, exact, mask, bounds); }), "") << "nothing is left";
}

TEST_F(ImageCheck, FailsNaNOtherSizesAndMissingBounds) {
    EXPECT_NE(failuresOf([&] { expectImage("a/b", actual, exact, {}, ImageBounds()); }), "");
    EXPECT_NE(failuresOf([&] { expectImage("a/b", actual, exact, {}, atMost(std::nan(""))); }), "");
    EXPECT_NE(failuresOf([&] { expectImage("a/b", FloatImage(4, 4, 1), exact, {}, atMost(1)); }), "");
    EXPECT_FALSE(record()["passed"]);
    actual.at(0, 0) = std::nanf("");
    EXPECT_NE(failuresOf([&] { expectImage("a/b", actual, exact, {}, atMost(1)); }), "");
    EXPECT_TRUE(left("error.png"));
}

}  // namespace
}  // namespace penumbra
