// The machine-readable result of a run: the contract with tests, benchmarks and graders.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/app/chapter.h"
#include "common/image/compare.h"

namespace penumbra {

/// Milliseconds.
struct TimeStatistics {
    double median = 0.0;
    double min = 0.0;
    double max = 0.0;
    int runs = 0;
};

/// Median of an even number of times: the mean of the middle two. Throws Error if there are none.
TimeStatistics statisticsOf(std::vector<double> milliseconds);

/// The picture against its exact answer.
struct ErrorReport {
    std::string view;      ///< that was compared
    std::string quantity;  ///< these three: of the TruthImage
    std::string truth;
    std::string against;
    ImageError figures;
    std::size_t background = 0;  ///< pixels left out, by reason
    std::size_t facingAway = 0;
    std::size_t straddling = 0;
    double truthMs = 0.0;  ///< what the exact answer took
};

struct Report {
    std::string chapter;
    std::string scene;
    std::string view;
    glm::ivec2 size{0};
    int antialias = 1;
    int camera = 0;
    std::uint32_t seed = 0;
    bool skip = true;                   ///< false: all skips are off
    std::vector<std::string> skipsOff;  ///< names
    bool still = false;
    std::string renderer;  ///< GL_RENDERER, or "CPU"
    std::string backend;   ///< "osmesa", ...; "none" for a CPU chapter
    std::string api;
    int threads = 0;  ///< that the machine can run at once
    std::string parametersJson;
    double setupMs = 0.0;  ///< from program start to the first frame
    TimeStatistics frameMs;
    TimeStatistics frameCpuMs;  ///< of all threads of the process
    std::map<std::string, TimeStatistics> passesMs;
    WorkCounters work;  ///< of one timed frame
    std::optional<ErrorReport> error;
    std::optional<ErrorReport> areaLightError;  ///< of a chapter that estimates something else
    std::vector<std::string> notes;             ///< the loader's
};

/// Schema 1: keys may be added, never renamed.
std::string reportJson(const Report& report);

/// A few lines for a human being.
std::string reportSummary(const Report& report);

}  // namespace penumbra
