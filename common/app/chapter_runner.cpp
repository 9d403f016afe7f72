// runChapter: one command line, a window or a picture, an exit status.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "common/app/chapter.h"
#include "common/app/chapter_session.h"
#include "common/app/command_line.h"
#include "common/app/headless_run.h"
#include "common/app/interrupt.h"
#include "common/app/progress.h"
#include "common/app/window_loop.h"
#include "common/error.h"
#include "common/system/memory_limit.h"

namespace penumbra {
namespace {

using Clock = std::chrono::steady_clock;

bool displayAnnounced() {
    const auto isSet = [](const char* variable) {
        const char* value = std::getenv(variable);
        return value && *value;
    };
    return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY");
}

/// Shows the chapter in a window and returns the exit status; none: there can be no window.
std::optional<int> runInWindow(ChapterSession& session) {
    if (session.context()) {
        if (!session.context()->window()) return std::nullopt;
        return runWindow({.session = session});
    }
    const auto context = createContext(contextRequest(session.info(), session.options(), false));
    if (!context->window()) return std::nullopt;
    return runWindow({.session = session, .context = context.get()});
}

/// What --compare-truth takes for each pixel: what two camera rays hit (PrimaryHits), and the exact answer,
/// its mask and the picture compared with it.
constexpr int truthBytesPerPixel = 320;

std::uint64_t pixelsOf(const glm::ivec2& size) {
    return std::uint64_t(size.x) * std::uint64_t(size.y);
}

/// What the picture will take, most. tests/unit/faults_test.cpp compares it with what it does take.
std::uint64_t pictureBytes(const ChapterInfo& info, const Options& options, bool headless) {
    if (!headless) return pixelsOf(options.windowSize) * std::uint64_t(info.bytesPerPixel);
    const std::uint64_t drawn =
        pixelsOf(options.size * options.antialias) * std::uint64_t(info.bytesPerPixel);
    return drawn + (options.compareTruth ? pixelsOf(options.size) * truthBytesPerPixel : 0);
}

/// Refuses a picture that cannot be had. Under a limit of memory, says so should a library crash on it all
/// the same.
void requireMemory(const ChapterInfo& info, const Options& options, bool headless) {
    requireMemoryForPicture(pictureBytes(info, options, headless));
    if (const auto limit = processMemoryLimit())
        sayOnCrash(
            fmt::format("{}: a library or the driver ended the program: not enough memory below {}, {} MB; "
                        "raise it, or use a smaller --size or --antialias",
                        info.name, limit->name, limit->bytes >> 20));
}

int run(const ChapterInfo& info, const std::function<std::unique_ptr<Chapter>()>& make, int argc,
        char** argv) {
    const Clock::time_point start = Clock::now();
    Parameters parameters;
    std::unique_ptr<Chapter> chapter = make();
    chapter->declare(parameters);
    std::optional<Options> options = parseCommandLine(info, parameters, argc, argv);
    if (!options) return exitFine;
    const bool headless = options->headless || (options->backend != Backend::window && !displayAnnounced());
    requireMemory(info, *options, headless);
    if (headless) prepareOutputs(info, *options);
    Progress progress(options->quiet);
    ChapterSession session(info, std::move(chapter), parameters, *options, headless, progress.callback());
    if (!headless) {
        if (const std::optional<int> status = runInWindow(session)) return *status;
        prepareOutputs(info, *options);
    }
    runHeadless(session, progress, start);
    return exitFine;
}

/// What was printed must have arrived: `--report - > /dev/full` has failed.
void requirePrinted() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error("standard output cannot be written: is the disk full?");
}

int fail(const ChapterInfo& info, const char* what, ExitStatus status) {
    fmt::print(stderr, "{}: {}\n", info.name, what);
    return status;
}

}  // namespace

int runChapter(const ChapterInfo& info, const std::function<std::unique_ptr<Chapter>()>& make, int argc,
               char** argv) {
    try {
        endCleanlyOnInterrupt();
        const int status = run(info, make, argc, argv);
        requirePrinted();
        return status;
    } catch (const Error& error) {
        return fail(info, error.what(), error.status());
    } catch (const std::bad_alloc&) {
        return fail(info, "not enough memory for this picture; use a smaller --size or --antialias",
                    exitFailed);
    } catch (const std::exception& error) {
        return fail(info, error.what(), exitFailed);
    }
}

}  // namespace penumbra
