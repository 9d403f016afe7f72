#include "common/app/headless_run.h"

#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <optional>
#include <thread>

#include "common/app/report.h"
#include "common/app/truth_comparison.h"
#include "common/error.h"
#include "common/gl/gl.h"
#include "common/image/file_write.h"
#include "common/image/image_file.h"
#include "common/image/resample.h"
#include "common/image/tone_map.h"

namespace penumbra {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// CPU time of all threads of this process: on a software renderer, the work itself.
double processCpuMs() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

void finish(const ChapterSession& session) {
    if (session.context()) glFinish();
}

/// The view that is drawn and timed. Truth and error are not drawn: they compare this one.
std::string drawnView(const ChapterSession& session) {
    const Options& options = session.options();
    if (options.view != "truth" && options.view != "error") return options.view;
    for (const ViewInfo& view : session.info().views)
        if (view.name == "visibility") return view.name;
    return session.info().views.front().name;
}

void timeFrames(ChapterSession& session, FrameRequest request, Report& report) {
    const Options& options = session.options();
    PassTimer first(session.context() != nullptr);
    if (options.passTimes) request.passTimer = &first;
    if (session.context())
        session.renderOffScreen(request);  // compiles shaders; a CPU chapter has nothing to warm up
    finish(session);
    request.passTimer = nullptr;
    // What no later frame does again: a bake. Passes of every frame are timed below, without the compiler.
    for (const auto& [pass, times] : first.times()) report.passesMs[pass] = statisticsOf(times);
    request.renderMapsAgain = !options.still;
    std::vector<double> wall, cpu;
    for (int run = 0; run < options.runs; ++run) {
        const double cpuStart = processCpuMs();
        const Clock::time_point start = Clock::now();
        session.renderOffScreen(request);
        finish(session);
        wall.push_back(millisecondsSince(start));
        cpu.push_back(processCpuMs() - cpuStart);
        if (options.runs > 1) session.progress()((run + 1.0) / options.runs);
    }
    report.frameMs = statisticsOf(wall);
    report.frameCpuMs = statisticsOf(cpu);
    report.work = session.work();
}

/// Further frames, so that waiting for each pass does not disturb the times of the frames above.
void timePasses(ChapterSession& session, FrameRequest request, Report& report) {
    if (!session.options().passTimes) return;
    PassTimer timer(session.context() != nullptr);
    request.passTimer = &timer;
    request.renderMapsAgain = !session.options().still;
    for (int run = 0; run < session.options().runs; ++run) session.renderOffScreen(request);
    for (const auto& [pass, times] : timer.times()) report.passesMs[pass] = statisticsOf(times);
}

Report describe(ChapterSession& session, const std::string& view) {
    const Options& options = session.options();
    Report report;
    report.chapter = session.info().name;
    report.scene = session.scene().name;
    report.view = view;
    report.size = options.size;
    report.antialias = options.antialias;
    report.camera = options.camera;
    report.seed = options.seed;
    report.skip = !session.parameters().skips().allOff();
    report.skipsOff = session.parameters().skips().off();
    report.still = options.still;
    const Context* context = session.context();
    report.renderer = context ? context->renderer() : "CPU";
    report.backend = context ? backendName(context->backend()) : "none";
    report.api = context ? apiName(context->capabilities().api) : "none";
    report.threads = int(std::thread::hardware_concurrency());
    report.parametersJson = session.parameters().toJson(true);
    report.notes = session.scene().notes;
    return report;
}

/// Of the error picture: what the brightest colour stands for. Fixed for visibility, so that chapters can be
/// compared.
float errorRange(const TruthComparison& comparison) {
    return comparison.report.quantity == "visibility" ? 1.0f : float(comparison.report.figures.maxAbs);
}

bool isLinear(const std::filesystem::path& file) {
    return file.extension() == ".exr" || file.extension() == ".EXR";
}

/// What to write, and for false colours what they mean.
struct OutputPicture {
    FloatImage image;
    std::string key = {};
};

std::string colourKey(float low, float high) {
    return fmt::format("  colours {:.4g} (dark blue) to {:.4g} (yellow)\n", low, high);
}

OutputPicture shownPicture(const ChapterSession& session, const FloatImage& picture, const ViewInfo& view) {
    OutputPicture output{session.display(picture, view)};
    if (!view.scalar || !view.falseColour) return output;
    const auto [low, high] = ChapterSession::colourRange(picture);
    output.key = colourKey(low, high);
    return output;
}

OutputPicture truthPicture(const ChapterSession& session, const TruthComparison& comparison) {
    if (isLinear(session.options().output)) return {definedTruth(comparison)};
    OutputPicture output =
        shownPicture(session, comparison.truth.value, session.view(comparison.report.view));
    output.image = greyWhereUndefined(output.image, comparison.truth.mask);
    return output;
}

OutputPicture errorPicture(const ChapterSession& session, const TruthComparison& comparison) {
    const FloatImage error = absoluteError(comparison);
    if (isLinear(session.options().output)) return {error};
    const float high = errorRange(comparison);
    return {greyWhereUndefined(falseColour(error, 0.0f, high), comparison.truth.mask), colourKey(0.0f, high)};
}

OutputPicture outputPicture(const ChapterSession& session, const FloatImage& picture,
                            const std::string& drawn, const std::optional<TruthComparison>& comparison) {
    if (session.options().view == "truth") return truthPicture(session, *comparison);
    if (session.options().view == "error") return errorPicture(session, *comparison);
    if (isLinear(session.options().output)) return {picture};
    return shownPicture(session, picture, session.view(drawn));
}

/// What a reference picture must carry to be made again; nothing that differs between two runs.
std::map<std::string, std::string> provenance(const ChapterSession& session, const Report& report) {
    return {{"penumbra:version", versionText},
            {"penumbra:chapter", report.chapter},
            {"penumbra:scene", report.scene},
            {"penumbra:view", session.options().view},
            {"penumbra:seed", std::to_string(report.seed)},
            {"penumbra:parameters", report.parametersJson},
            {"penumbra:renderer", report.renderer}};
}

void tell(const Options& options, const Report& report, const std::string& key) {
    if (options.report == "-") {
        std::fputs(reportJson(report).c_str(), stdout);
        return;
    }
    if (!options.report.empty()) writeTextFile(options.report, reportJson(report));
    if (options.quiet) return;
    fmt::print("{}{}", reportSummary(report), key);
    if (!options.output.empty()) fmt::print("  wrote   {}\n", options.output.string());
    if (!options.report.empty()) fmt::print("  wrote   {}\n", options.report.string());
}

}  // namespace

void prepareOutputs(const ChapterInfo& info, Options& options) {
    if (options.output.empty() && options.report.empty()) options.output = "out/" + info.name + ".png";
    if (!options.output.empty()) requireWritable(options.output);
    if (!options.report.empty() && options.report != "-") requireWritable(options.report);
}

void runHeadless(ChapterSession& session, Progress& progress, Clock::time_point start) {
    const Options& options = session.options();
    const std::string drawn = drawnView(session);
    const FrameRequest request{
        .view = drawn, .camera = session.camera(), .size = options.size * options.antialias};
    Report report = describe(session, drawn);
    report.setupMs = millisecondsSince(start);
    progress.start("rendering");
    timeFrames(session, request, report);
    const FloatImage picture = boxFilter(session.readBack(drawn), options.antialias);
    timePasses(session, request, report);
    std::optional<TruthComparison> comparison;
    if (options.compareTruth) {
        progress.start("exact answer");
        const DrawnPicture onePerPixel{drawn, options.antialias == 1 ? &picture : nullptr};
        comparison = compareWithTruth(session, options.view, onePerPixel);
        report.error = comparison->report;
        report.areaLightError = comparison->areaLight;
    }
    progress.finish();
    std::string key;
    if (!options.output.empty()) {
        const OutputPicture output = outputPicture(session, picture, drawn, comparison);
        writeImage(options.output, output.image, provenance(session, report));
        key = output.key;
    }
    tell(options, report, key);
}

}  // namespace penumbra
