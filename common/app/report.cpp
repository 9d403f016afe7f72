#include "common/app/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/app/command_line.h"
#include "common/error.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;
constexpr int schemaVersion = 1;

Json toJson(const TimeStatistics& time) {
    return {{"median", time.median}, {"min", time.min}, {"max", time.max}, {"runs", time.runs}};
}

Json toJson(const ErrorReport& error) {
    const ImageError& figures = error.figures;
    return {{"quantity", error.quantity},
            {"truth", error.truth},
            {"against", error.against},
            {"view", error.view},
            {"pixels", figures.pixels},
            {"rmse", figures.rmse},
            {"mean_abs", figures.meanAbs},
            {"max_abs", figures.maxAbs},
            {"bias", figures.bias},
            {"excluded",
             {{"pixels", figures.excluded},
              {"background", error.background},
              {"facing_away", error.facingAway},
              {"straddling", error.straddling}}},
            {"truth_ms", error.truthMs}};
}

Json timeJson(const Report& report) {
    Json time{{"setup_ms", report.setupMs},
              {"frame_ms", toJson(report.frameMs)},
              {"frame_cpu_ms", toJson(report.frameCpuMs)}};
    for (const auto& [pass, statistics] : report.passesMs) time["passes_ms"][pass] = toJson(statistics);
    return time;
}

std::string errorSummary(const ErrorReport& error) {
    const ImageError& f = error.figures;
    std::string text = fmt::format("  error   {} against {} ({}): rmse {:.4g}, max {:.4g}, bias {:+.3g}\n",
                                   error.quantity, error.against, error.truth, f.rmse, f.maxAbs, f.bias);
    text +=
        fmt::format("          over {} pixels; left out: {} background, {} facing away, {} on silhouettes\n",
                    f.pixels, error.background, error.facingAway, error.straddling);
    return text;
}

}  // namespace

TimeStatistics statisticsOf(std::vector<double> milliseconds) {
    if (milliseconds.empty()) throw Error("no frame was timed, so there is no median time");
    std::sort(milliseconds.begin(), milliseconds.end());
    const std::size_t count = milliseconds.size();
    const double median = 0.5 * (milliseconds[(count - 1) / 2] + milliseconds[count / 2]);
    return {median, milliseconds.front(), milliseconds.back(), int(count)};
}

std::string reportJson(const Report& report) {
    Json json{{"schema", schemaVersion},
              {"version", versionText},
              {"chapter", report.chapter},
              {"scene", report.scene},
              {"camera", report.camera},
              {"view", report.view},
              {"size", {report.size.x, report.size.y}},
              {"antialias", report.antialias},
              {"seed", report.seed},
              {"skip", report.skip},
              {"skips_off", report.skipsOff},
              {"still", report.still},
              {"renderer", report.renderer},
              {"backend", report.backend},
              {"api", report.api},
              {"threads", report.threads}};
    json["parameters"] = Json::parse(report.parametersJson);
    json["time"] = timeJson(report);
    json["work"] = report.work;
    if (report.error) json["error"] = toJson(*report.error);
    if (report.areaLightError) json["error_area_light"] = toJson(*report.areaLightError);
    json["notes"] = report.notes;
    // Names of scenes come from file names, which need not be UTF-8: replace what is not.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string reportSummary(const Report& report) {
    std::string text = fmt::format("{}: {}, view {}, {}x{}\n", report.chapter, report.scene, report.view,
                                   report.size.x, report.size.y);
    for (const std::string& note : report.notes) text += fmt::format("  note    {}\n", note);
    text += fmt::format("  with    {} ({}, {} threads)\n", report.renderer, report.backend, report.threads);
    text += fmt::format("  time    {:.1f} ms a frame, {:.1f} ms of CPU (median of {}); {:.0f} ms to set up\n",
                        report.frameMs.median, report.frameCpuMs.median, report.frameMs.runs, report.setupMs);
    for (const auto& [pass, statistics] : report.passesMs)
        text += fmt::format("          {:.1f} ms {}\n", statistics.median, pass);
    for (const auto& error : {report.error, report.areaLightError})
        if (error) text += errorSummary(*error);
    return text;
}

}  // namespace penumbra
