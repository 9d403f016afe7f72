// The command line that every chapter has (CLI11 inside), the same for all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "common/app/chapter.h"
#include "common/gl/context.h"

namespace penumbra {

constexpr const char* versionText = "0.1.0";
constexpr int largestSize = 16384;  ///< pixels, width and height
constexpr int largestAntialias = 16;

/// What the user asked for, checked.
struct Options {
    bool headless = false;  ///< --headless, or implied by --output and --report
    Backend backend = Backend::automatic;
    Api api = Api::desktop;
    std::string scene = "courtyard";   ///< name in assets/, or a file
    int camera = 0;                    ///< index into Scene::cameras
    glm::ivec2 size{512, 512};         ///< pixels
    glm::ivec2 windowSize{1280, 800};  ///< of the window when it opens, screen units; --size sets both
    int antialias = 1;                 ///< N: rendered N x N larger, then box-filtered
    std::string view = "color";
    std::optional<double> exposureEv;  ///< stops relative to the scene's own exposure, as 2^EV; none: auto
    std::filesystem::path output;      ///< empty: none
    std::filesystem::path report;      ///< empty: none; "-": standard output
    bool compareTruth = false;
    int runs = 1;        ///< timed frames
    bool still = false;  ///< timed frames may keep maps from the frame before
    bool passTimes = false;
    std::uint32_t seed = 1;
    bool quiet = false;
};

/// Parses the command line of a chapter; values of its parameters and skips go straight into `parameters`.
/// None: the command was answered on standard output already (--help, --version, --list-parameters). Throws
/// UsageError: one line that names the flag, the value given and what is allowed.
std::optional<Options> parseCommandLine(const ChapterInfo& info, Parameters& parameters, int argc,
                                        const char* const* argv);

/// "512x512" to pixels. Throws UsageError.
glm::ivec2 parseSize(const std::string& text);

}  // namespace penumbra
