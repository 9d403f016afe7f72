#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/stress/sweep.h"

namespace penumbra::stress {
namespace {

using Json = nlohmann::ordered_json;

/// Four digits say all that a page shows; JSON has no infinity.
Json figure(double value) {
    if (!std::isfinite(value)) return fmt::format("{}", value);
    return std::stod(fmt::format("{:.4g}", value));
}

Json figures(const std::map<std::string, double>& values) {
    Json json = Json::object();
    for (const auto& [name, value] : values) json[name] = figure(value);
    return json;
}

Json binsOf(const Axis& axis, const std::vector<BinResult>& bins) {
    Json json = Json::array();
    const std::vector<std::string> names = axis.binNames();
    for (std::size_t i = 0; i < bins.size(); ++i)
        json.push_back({{"from", names[i]},
                        {"cases", bins[i].cases},
                        {"refused", bins[i].refused},
                        {"failed", bins[i].failed},
                        {"worst", figures(bins[i].worst)}});
    return json;
}

Json jsonOf(const SubjectResult& result) {
    Json json{{"name", result.subject->name}, {"claim", result.subject->claim},
              {"cases", result.cases},        {"refused", result.refused},
              {"failed", result.failed},      {"cpu_seconds", figure(result.cpuSeconds)},
              {"refusals", result.refusals},  {"worst", Json::array()},
              {"failures", Json::array()},    {"bins", Json::object()}};
    for (const auto& [name, worst] : result.worst)
        json["worst"].push_back(
            {{"name", name}, {"value", figure(worst.value)}, {"command", commandLine(worst.where)}});
    for (const Failure& failure : result.failures)
        json["failures"].push_back({{"what", failure.what},
                                    {"command", commandLine(failure.shrunk)},
                                    {"drawn", commandLine(failure.drawn)}});
    for (const std::string& axis : result.subject->axes)
        if (const auto bins = result.bins.find(axis); bins != result.bins.end())
            json["bins"][axis] = binsOf(axisNamed(axis), bins->second);
    return json;
}

}  // namespace

std::string commandLine(const Case& given) {
    return "build/release/bin/stress " + flagsOf(given);
}

std::string reportJson(const SweepResult& result) {
    Json json{{"schema", 1},
              {"seed", result.seed},
              {"cases", result.cases},
              {"refused", result.refused},
              {"failed", result.failed},
              {"interrupted", result.interrupted},
              {"seconds", figure(result.seconds)},
              {"cpu_seconds", figure(result.cpuSeconds)},
              {"cases_per_second", figure(double(result.cases) / std::max(result.seconds, 1e-9))},
              {"axes", Json::array()},
              {"subjects", Json::array()}};
    for (const Axis& axis : allAxes())
        json["axes"].push_back({{"name", axis.name}, {"unit", axis.unit}, {"help", axis.help}});
    for (const SubjectResult& subject : result.subjects) json["subjects"].push_back(jsonOf(subject));
    return json.dump(1) + "\n";
}

std::string summaryOf(const SweepResult& result) {
    std::string text;
    for (const SubjectResult& subject : result.subjects) {
        text += fmt::format("{:<22} {:>7} cases {:>6} refused {:>5} failed {:>9.2f} ms each\n",
                            subject.subject->name, subject.cases, subject.refused, subject.failed,
                            1e3 * subject.cpuSeconds / double(std::max<std::uint64_t>(subject.cases, 1)));
        for (const auto& [name, worst] : subject.worst)
            text += fmt::format("  {:<34} {:<11.4g} {}\n", name, worst.value, flagsOf(worst.where));
        for (const auto& [why, times] : subject.refusals)
            text += fmt::format("  refused {:>6} times: {}\n", times, why);
    }
    text += fmt::format(
        "{} cases, {} refused, {} failed; {:.0f} s, {:.0f} s of CPU, {:.0f} cases a second{}\n", result.cases,
        result.refused, result.failed, result.seconds, result.cpuSeconds,
        double(result.cases) / std::max(result.seconds, 1e-9), result.interrupted ? "; interrupted" : "");
    return text;
}

}  // namespace penumbra::stress
