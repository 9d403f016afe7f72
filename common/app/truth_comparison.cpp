#include "common/app/truth_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "common/error.h"

namespace penumbra {
namespace {

constexpr float undefinedValue = std::numeric_limits<float>::quiet_NaN();

/// Views in the order in which an exact answer is asked for.
std::vector<std::string> candidates(const ChapterInfo& info, const std::string& preferred) {
    std::vector<std::string> names;
    const bool specific = preferred != "color" && preferred != "truth" && preferred != "error";
    if (specific) names.push_back(preferred);
    names.push_back("visibility");
    for (const ViewInfo& view : info.views) names.push_back(view.name);
    return names;
}

bool hasView(const ChapterInfo& info, const std::string& name) {
    return std::any_of(info.views.begin(), info.views.end(),
                       [&](const ViewInfo& view) { return view.name == name; });
}

TruthRequest requestFor(ChapterSession& session, const RayTracer& tracer, const std::string& view) {
    return {session.scene(),    tracer,           session.camera(), session.options().size, view,
            session.progress(), session.context()};
}

/// Sets view and truth of `comparison`.
void findTruth(ChapterSession& session, const RayTracer& tracer, const std::string& preferred,
               TruthComparison& comparison) {
    for (const std::string& name : candidates(session.info(), preferred)) {
        if (!hasView(session.info(), name)) continue;
        try {
            comparison.truth = session.chapter().truth(requestFor(session, tracer, name));
            comparison.report.view = name;
            return;
        } catch (const UsageError&) {  // no exact answer for this view: try the next
        }
    }
    throw UsageError(
        fmt::format("--compare-truth: {} has no exact answer for any of its views", session.info().name));
}

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void describe(ErrorReport& report, const FloatImage& actual, const TruthImage& truth) {
    report.quantity = truth.quantity;
    report.truth = truth.method;
    report.against = truth.against;
    report.background = truth.background;
    report.facingAway = truth.facingAway;
    report.straddling = truth.straddling;
    report.figures = compareImages(actual, truth.value, truth.mask);
}

}  // namespace

TruthComparison compareWithTruth(ChapterSession& session, const std::string& preferred,
                                 const DrawnPicture& drawn) {
    TruthComparison comparison;
    const RayTracer tracer(session.scene());
    const auto start = std::chrono::steady_clock::now();
    findTruth(session, tracer, preferred, comparison);
    ErrorReport& report = comparison.report;
    report.truthMs = millisecondsSince(start);
    comparison.actual =
        drawn.picture && drawn.view == report.view
            ? *drawn.picture
            : session.picture(
                  {.view = report.view, .camera = session.camera(), .size = session.options().size});
    describe(report, comparison.actual, comparison.truth);

    const auto areaStart = std::chrono::steady_clock::now();
    if (const auto exact = session.chapter().areaLightTruth(requestFor(session, tracer, report.view))) {
        ErrorReport& areaLight = comparison.areaLight.emplace();
        areaLight.view = report.view;
        areaLight.truthMs = millisecondsSince(areaStart);
        describe(areaLight, comparison.actual, *exact);
    }
    return comparison;
}

FloatImage absoluteError(const TruthComparison& comparison) {
    const FloatImage& actual = comparison.actual;
    const FloatImage& exact = comparison.truth.value;
    FloatImage result(actual.width, actual.height, 1, undefinedValue);
    for (int y = 0; y < actual.height; ++y) {
        for (int x = 0; x < actual.width; ++x) {
            if (comparison.truth.mask.at(x, y) == 0.0f) continue;
            float most = 0.0f;
            for (int c = 0; c < actual.channels; ++c)
                most = std::max(most, std::abs(actual.at(x, y, c) - exact.at(x, y, c)));
            result.at(x, y) = most;
        }
    }
    return result;
}

FloatImage definedTruth(const TruthComparison& comparison) {
    FloatImage result = comparison.truth.value;
    for (std::size_t i = 0; i < result.values.size(); ++i)
        if (comparison.truth.mask.values[i / std::size_t(result.channels)] == 0.0f)
            result.values[i] = undefinedValue;
    return result;
}

FloatImage greyWhereUndefined(const FloatImage& shown, const FloatImage& mask) {
    constexpr float grey =
        0.2f;  // linear; darker than the middle of the false colours, and without their hue
    FloatImage result(shown.width, shown.height, 3, grey);
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
        if (mask.values[i] == 0.0f) continue;
        for (std::size_t c = 0; c < 3; ++c)
            result.values[3 * i + c] =
                shown.values[i * std::size_t(shown.channels) + (shown.channels == 3 ? c : 0)];
    }
    return result;
}

}  // namespace penumbra
