#include "tests/image/image_check.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/image/image_file.h"

namespace penumbra {

namespace {

using Json = nlohmann::json;

/// One checked bound: what it is called, what was measured, and what was allowed.
struct Verdict {
    const char* name;
    double measured;
    double bound;
    bool kept() const { return measured <= bound; }  // a NaN keeps no bound
};

std::vector<Verdict> judge(const ImageError& error, const ImageBounds& bounds) {
    const double all = double(error.pixels + error.excluded);
    std::vector<Verdict> verdicts;
    const auto check = [&verdicts](const char* name, double measured, double bound) {
        if (bound != std::numeric_limits<double>::infinity()) verdicts.push_back({name, measured, bound});
    };
    check("rmse", error.rmse, bounds.rmse);
    check("mean_abs", error.meanAbs, bounds.meanAbs);
    check("max_abs", error.maxAbs, bounds.maxAbs);
    check("abs_bias", std::abs(error.bias), bounds.absBias);
    if (verdicts.empty()) throw Error("no bound is given: the comparison could never fail");
    check("excluded_share", double(error.excluded) / all, bounds.excludedShare);
    return verdicts;
}

std::filesystem::path folderOf(const std::string& name) {
    const char* replaced = std::getenv("PENUMBRA_TEST_OUTPUT");
    return std::filesystem::path(replaced ? replaced : PENUMBRA_SOURCE_DIR "/out/test") / name;
}

std::string runningTest() {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    return info ? fmt::format("{}.{}", info->test_suite_name(), info->name()) : "";
}

/// Both pictures of a pair are divided by the same number, so that they stay comparable: the largest exact
/// value, unless it fits already.
float displayScale(const FloatImage& exact) {
    float largest = 1.0f;
    for (const float value : exact.values) {
        if (std::isfinite(value)) largest = std::max(largest, value);
    }
    return 1.0f / largest;
}

FloatImage scaled(FloatImage image, float factor) {
    for (float& value : image.values) value *= factor;
    return image;
}

void writePictures(const std::filesystem::path& folder, const FloatImage& actual, const FloatImage& exact,
                   const FloatImage& mask) {
    const float scale = displayScale(exact);
    writeImage(folder / "actual.exr", actual);
    writeImage(folder / "exact.exr", exact);
    writeImage(folder / "actual.png", scaled(actual, scale));
    writeImage(folder / "exact.png", scaled(exact, scale));
    writeImage(folder / "error.png", errorImage(actual, exact, mask, 10.0f * scale));
}

Json figures(const ImageError& error, const std::vector<Verdict>& verdicts) {
    Json record{{"pixels", error.pixels},    {"excluded", error.excluded}, {"rmse", error.rmse},
                {"mean_abs", error.meanAbs}, {"max_abs", error.maxAbs},    {"bias", error.bias},
                {"bounds", Json::array()},   {"worst", Json::array()}};
    for (const Verdict& v : verdicts) {
        record["bounds"].push_back(
            {{"name", v.name}, {"measured", v.measured}, {"bound", v.bound}, {"kept", v.kept()}});
    }
    for (const WorstPixel& w : error.worst) {
        record["worst"].push_back({{"x", w.x}, {"y", w.y}, {"actual", w.actual}, {"exact", w.exact}});
    }
    return record;
}

std::string explain(const std::string& name, const std::vector<Verdict>& verdicts, const ImageError& error) {
    std::string text = name + " differs from its exact answer\n";
    for (const Verdict& v : verdicts) {
        text += fmt::format("  {} {:.6g}, allowed {:.6g}{}\n", v.name, v.measured, v.bound,
                            v.kept() ? "" : "   <-- broken");
    }
    text += "  worst pixels (x right, y down):\n";
    for (const WorstPixel& w : error.worst) {
        text += fmt::format("    ({}, {}): actual {:.9g}, exact {:.9g}\n", w.x, w.y, w.actual, w.exact);
    }
    return text + "  pictures: " + folderOf(name).string();
}

void writeRecord(const std::string& name, Json record, bool passed) {
    record["name"] = name;
    record["test"] = runningTest();
    record["passed"] = passed;
    writeTextFile(folderOf(name) / "record.json", record.dump(1) + "\n");
}

}  // namespace

ImageError expectImage(const std::string& name, const FloatImage& actual, const FloatImage& exact,
                       const FloatImage& mask, const ImageBounds& bounds) {
    // What an earlier run left here would be taken for this run's.
    std::filesystem::remove_all(folderOf(name));
    ImageError error;
    try {
        error = compareImages(actual, exact, mask);
        const std::vector<Verdict> verdicts = judge(error, bounds);
        const bool passed =
            std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.kept(); });
        if (!passed) {
            writePictures(folderOf(name), actual, exact, mask);
            ADD_FAILURE() << explain(name, verdicts, error);
        }
        writeRecord(name, figures(error, verdicts), passed);
    } catch (const Error& problem) {
        ADD_FAILURE() << name << ": " << problem.what();
        writeRecord(name, {{"problem", problem.what()}}, false);
    }
    return error;
}

}  // namespace penumbra
