#include "common/app/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/app/command_line.h"
#include "common/error.h"

namespace penumbra {
namespace {

using Json = nlohmann::json;

Report example() {
    Report report;
    report.chapter = "04_pcf";
    report.scene = "heckbert_herf";
    report.view = "irradiance";
    report.size = {640, 480};
    report.renderer = "llvmpipe";
    report.backend = "osmesa";
    report.api = "desktop";
    report.threads = 2;
    report.antialias = 4;
    report.camera = 1;
    report.seed = 77;
    report.skip = false;
    report.skipsOff = {"kept-maps"};
    report.still = true;
    report.notes = {"no light: a sun was added"};
    report.parametersJson = R"({"kernel-width": 3, "bias": 0.1})";
    report.setupMs = 12.5;
    report.frameMs = statisticsOf({3.0, 1.0, 2.0});
    report.frameCpuMs = statisticsOf({4.0});
    report.work = {{"shadow_maps_rendered", 1}, {"triangles_submitted", 5'000'000'000}};
    return report;
}

TEST(Report, TheMedianIsTheMiddleOrTheMeanOfTheMiddleTwo) {
    EXPECT_EQ(statisticsOf({5.0, 1.0, 3.0}).median, 3.0);
    EXPECT_EQ(statisticsOf({8.0, 1.0, 3.0, 2.0}).median, 2.5);
    EXPECT_EQ(statisticsOf({8.0, 1.0, 3.0}).min, 1.0);
    EXPECT_EQ(statisticsOf({8.0, 1.0, 3.0}).max, 8.0);
    EXPECT_EQ(statisticsOf({8.0, 1.0, 3.0}).runs, 3);
    EXPECT_THROW(statisticsOf({}), Error);
}

TEST(Report, HoldsEveryKeyOfTheContract) {
    const Json json = Json::parse(reportJson(example()));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["chapter"], "04_pcf");
    EXPECT_EQ(json["scene"], "heckbert_herf");
    EXPECT_EQ(json["size"], Json::parse("[640, 480]"));
    EXPECT_EQ(json["renderer"], "llvmpipe");
    EXPECT_EQ(json["backend"], "osmesa");
    EXPECT_EQ(json["threads"], 2);
    EXPECT_EQ(json["version"], versionText);
    EXPECT_EQ(json["api"], "desktop");
    EXPECT_EQ(json["view"], "irradiance");
    EXPECT_EQ(json["antialias"], 4);
    EXPECT_EQ(json["camera"], 1);
    EXPECT_EQ(json["seed"], 77);
    EXPECT_EQ(json["skip"], false);
    EXPECT_EQ(json["skips_off"], Json::parse(R"(["kept-maps"])"));
    EXPECT_EQ(json["still"], true);
    EXPECT_EQ(json["notes"], Json::parse(R"(["no light: a sun was added"])"));
    EXPECT_EQ(json["parameters"], Json::parse(R"({"kernel-width": 3, "bias": 0.1})"));
    EXPECT_EQ(json["time"]["setup_ms"], 12.5);
    EXPECT_EQ(json["time"]["frame_ms"], Json::parse(R"({"median": 2.0, "min": 1.0, "max": 3.0, "runs": 3})"));
    EXPECT_EQ(json["time"]["frame_cpu_ms"]["median"], 4.0);
    EXPECT_EQ(json["work"]["shadow_maps_rendered"], 1);
    EXPECT_EQ(json["work"]["triangles_submitted"], 5'000'000'000);
    EXPECT_FALSE(json.contains("error")) << "no comparison, no error figure";
    EXPECT_FALSE(json["time"].contains("passes_ms"));
}

TEST(Report, AnErrorComesWithWhatItWasMeasuredAgainstAndWhatWasLeftOut) {
    Report report = example();
    report.passesMs["depth"] = statisticsOf({1.5});
    ErrorReport error;
    error.view = "S";
    error.quantity = "visibility";
    error.truth = "closed form";
    error.against = "point light";
    error.truthMs = 31.5;
    error.figures.pixels = 90;
    error.figures.excluded = 10;
    error.figures.rmse = 0.25;
    error.figures.meanAbs = 0.125;
    error.figures.maxAbs = 1.0;
    error.figures.bias = -0.0625;
    error.background = 5;
    error.facingAway = 3;
    error.straddling = 2;
    report.error = error;
    const Json json = Json::parse(reportJson(report));
    EXPECT_EQ(json["time"]["passes_ms"]["depth"]["median"], 1.5);
    const Json& e = json["error"];
    EXPECT_EQ(e["quantity"], "visibility");
    EXPECT_EQ(e["view"], "S");
    EXPECT_EQ(e["truth_ms"], 31.5);
    EXPECT_EQ(e["truth"], "closed form");
    EXPECT_EQ(e["against"], "point light");
    EXPECT_EQ(e["pixels"], 90);
    EXPECT_EQ(e["rmse"], 0.25);
    EXPECT_EQ(e["mean_abs"], 0.125);
    EXPECT_EQ(e["max_abs"], 1.0);
    EXPECT_EQ(e["bias"], -0.0625);
    EXPECT_EQ(e["excluded"],
              Json::parse(R"({"pixels": 10, "background": 5, "facing_away": 3, "straddling": 2})"));
    const std::string summary = reportSummary(report);
    EXPECT_NE(summary.find("rmse 0.25"), std::string::npos);
    EXPECT_NE(summary.find("5 background, 3 facing away, 2 on silhouettes"), std::string::npos);
}

TEST(Report, TheAreaLightsErrorStandsBesideTheOther) {
    Report report = example();
    report.error.emplace().against = "filter";
    report.error->figures.rmse = 0.125;
    EXPECT_FALSE(Json::parse(reportJson(report)).contains("error_area_light"));
    report.areaLightError.emplace().against = "area light";
    report.areaLightError->figures.rmse = 0.5;
    const Json json = Json::parse(reportJson(report));
    EXPECT_EQ(json["error"]["against"], "filter");
    EXPECT_EQ(json["error_area_light"]["against"], "area light");
    EXPECT_EQ(json["error_area_light"]["rmse"], 0.5);
    const std::string summary = reportSummary(report);
    EXPECT_LT(summary.find("rmse 0.125"), summary.find("rmse 0.5"));
}

TEST(Report, ANameThatIsNotUtf8StillGivesValidJson) {
    Report report = example();
    report.scene = "caf\xe9";
    EXPECT_TRUE(Json::accept(reportJson(report)));
}

}  // namespace
}  // namespace penumbra
