// Chapter 00 as a program: its report's figures against the exact answer, and what must not change a bit.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/image/test_scenes.h"
#include "tests/unit/run_program.h"

namespace penumbra {
namespace {

class Chapter00 : public testing::Test {
 protected:
    nlohmann::json report(const std::string& scene, std::vector<std::string> arguments) const {
        const std::filesystem::path file = folder_ / "report.json";
        const std::vector<std::string> common = {"--scene", scene,      "--size",
                                                 "192x192", "--report", file.string()};
        arguments.insert(arguments.end(), common.begin(), common.end());
        const ProgramResult result = runProgram({.program = programFolder() / "00_ray_traced_truth",
                                                 .arguments = arguments,
                                                 .folder = folder_.path()});
        EXPECT_EQ(result.status, 0) << result.err;
        const std::string text = bytesOf(file);
        return text.empty() ? nlohmann::json::object() : nlohmann::json::parse(text);
    }
    double rmse(const std::string& scene, std::vector<std::string> arguments) const {
        arguments.push_back("--compare-truth");
        return report(scene, arguments).at("error").at("rmse");
    }
    std::string picture(const std::string& scene, std::vector<std::string> arguments) const {
        const std::filesystem::path file = folder_ / "picture.exr";
        arguments.insert(arguments.end(), {"--output", file.string()});
        report(scene, arguments);
        return bytesOf(file);
    }
    const TemporaryFolder folder_;
};

class Chapter00Scenes : public Chapter00, public testing::WithParamInterface<std::string> {};

TEST_P(Chapter00Scenes, VisibilityOfEveryLightIsTheExactOne) {
    const std::string scene = GetParam();
    const nlohmann::json first = report(scene, {"--view", "visibility", "--light", "0", "--compare-truth"});
    const nlohmann::json& error = first.at("error");
    EXPECT_GT(error.at("pixels").get<int>(), 192 * 192 / 20);
    if (error.at("against") == "point light") {
        // Rays in float against segments in double: they may differ where a shadow's edge passes a pixel's
        // centre by less than 2e-6 of the scene: one pixel of a picture in ten, say, so four are far too
        // many.
        EXPECT_LE(error.at("mean_abs").get<double>() * error.at("pixels").get<double>(), 4.0);
    } else {
        // 64 Owen-scrambled samples in a penumbra have rms 0.017 (a half-plane's; N^-3/4); the mean over a
        // picture that is partly lit or dark is lower.
        EXPECT_LE(error.at("rmse").get<double>(), 0.02);
    }
    EXPECT_LE(std::abs(error.at("bias").get<double>()), 0.003);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Chapter00Scenes, testing::ValuesIn(testScenes()), sceneTestName);

TEST_F(Chapter00, ErrorFallsWithTheSamplesAsTheTheorySays) {
    const std::vector<std::string> view = {"--view", "visibility", "--adaptive", "off", "--samples"};
    const auto at = [&](const char* samples) {
        std::vector<std::string> arguments = view;
        arguments.push_back(samples);
        return rmse("heckbert_herf", arguments);
    };
    // Edges limit every sampler to N^-3/4 (Alexander 1990); three fixed edge directions do a little better.
    const double slope = std::log(at("1024") / at("16")) / std::log(64.0);
    EXPECT_LE(slope, -0.70);
    EXPECT_GE(slope, -0.95);
}

TEST_F(Chapter00, IrradianceIsExactWhereNothingStandsInBetween) {
    // The ratio estimator: with one sample, lit pixels have no error at all, but pixels in the penumbra do.
    const nlohmann::json one =
        report("heckbert_herf", {"--view", "irradiance", "--samples", "1", "--compare-truth"});
    const nlohmann::json many =
        report("heckbert_herf", {"--view", "irradiance", "--samples", "256", "--compare-truth"});
    EXPECT_LT(many.at("error").at("rmse").get<double>(), 0.1 * one.at("error").at("rmse").get<double>());
}

TEST_F(Chapter00, TwoRunsAndAllTheWorkGiveTheSamePicture) {
    const std::string usual = picture("heckbert_herf", {});
    EXPECT_FALSE(usual.empty());
    EXPECT_EQ(picture("heckbert_herf", {}), usual);
    EXPECT_EQ(picture("heckbert_herf", {"--skip-none"}), usual);
    EXPECT_NE(picture("heckbert_herf", {"--seed", "7"}), usual);
}

TEST_F(Chapter00, CountsEveryRay) {
    const nlohmann::json work = report("heckbert_herf", {"--samples", "64"}).at("work");
    const auto count = [&](const char* name) { return work.at(name).get<std::int64_t>(); };
    EXPECT_EQ(count("primary_rays"), 192 * 192);
    EXPECT_GT(count("rays_saved_by_agreement"), 0);
    EXPECT_LE(count("shadow_rays") + count("rays_saved_by_agreement") + count("rays_saved_facing_away"),
              64 * count("pixels_receiving"));
}

TEST_F(Chapter00, AsksMoreOnlyWhereTheFirstRaysDisagreeAndLosesLittle) {
    const nlohmann::json adaptive =
        report("heckbert_herf", {"--view", "visibility", "--samples", "256", "--compare-truth"});
    const nlohmann::json all = report("heckbert_herf", {"--view", "visibility", "--samples", "256",
                                                        "--compare-truth", "--adaptive", "off"});
    EXPECT_LT(adaptive.at("work").at("shadow_rays").get<double>(),
              0.9 * all.at("work").at("shadow_rays").get<double>());
    // A penumbra that 16 rays miss is lost up to 1/16 of the light: that, and no more.
    EXPECT_LE(adaptive.at("error").at("rmse").get<double>(), 1.0 / 16.0);
    EXPECT_GT(adaptive.at("error").at("rmse").get<double>(), all.at("error").at("rmse").get<double>());
}

// Where the panel rises over the knot's horizon the first 16 samples may all be below it. Counted as rays
// that agree, they left such pixels dark: an error of 1 each, and more than twice that of all rays over the
// picture.
TEST_F(Chapter00, SamplesBelowTheHorizonHaveNoSayInWhetherTheFirstRaysAgree) {
    std::vector<std::string> flags = {"--light", "1", "--view", "visibility", "--samples", "64"};
    const double adaptive = rmse("knot", flags);
    flags.insert(flags.end(), {"--adaptive", "off"});
    EXPECT_LE(adaptive, 1.2 * rmse("knot", flags));
}

TEST_F(Chapter00, ARoundedStartMakesAcne) {
    const std::vector<std::string> exact = {"--view", "visibility", "--light", "0"};
    std::vector<std::string> rounded = exact;
    rounded.insert(rounded.end(), {"--start", "rounded"});
    EXPECT_LE(rmse(thirdPartyModel, exact), 0.02);
    // Rounding puts about half of the points of tilted surfaces behind them.
    EXPECT_GE(rmse(thirdPartyModel, rounded), 0.3);
}

TEST_F(Chapter00, RefusesALightThatIsNotThere) {
    const ProgramResult result =
        runProgram({.program = programFolder() / "00_ray_traced_truth",
                    .arguments = {"--scene", "heckbert_herf", "--light", "60", "--headless"},
                    .folder = folder_.path()});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.errorLines(), 1);
}

}  // namespace
}  // namespace penumbra
