// Many cases of many subjects, counted.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/stress/case.h"

namespace penumbra::stress {

struct SweepRequest {
    std::vector<const Subject*> subjects;
    std::uint64_t cases = 2000;  ///< over all subjects, by their shares; at least one each
    std::uint64_t seed = 1;
    std::map<std::string, double> pinned = {};  ///< axes that have one value in all cases
    std::function<void(double fraction)> progress = [](double) {};
    std::function<bool()> stop = [] { return false; };  ///< asked after each case
    std::function<void(const std::string& line)> say = [](const std::string&) {
    };  ///< a failure, when it is found
};

struct Failure {
    Case drawn, shrunk;
    std::string what;  ///< of the shrunk case
};

/// The largest value of a measurement, and the case that gave it.
struct Worst {
    double value = 0.0;
    Case where;
};

/// The cases of one piece of an axis.
struct BinResult {
    std::uint64_t cases = 0, refused = 0, failed = 0;
    std::map<std::string, double> worst = {};
};

struct SubjectResult {
    const Subject* subject = nullptr;
    std::uint64_t cases = 0, refused = 0, failed = 0;
    double cpuSeconds = 0.0;
    std::map<std::string, std::uint64_t> refusals = {};       ///< how often each was said
    std::map<std::string, Worst> worst = {};                  ///< by measurement
    std::map<std::string, std::vector<BinResult>> bins = {};  ///< by axis
    std::vector<Failure> failures = {};                       ///< the first few, shrunk
};

struct SweepResult {
    std::uint64_t seed = 0, cases = 0, refused = 0, failed = 0;
    double seconds = 0.0, cpuSeconds = 0.0;
    bool interrupted = false;
    std::vector<SubjectResult> subjects = {};
};

SweepResult sweep(const SweepRequest& request);

/// Several lines for a terminal.
std::string summaryOf(const SweepResult& result);
/// What tools/stress_page.py makes a page of.
std::string reportJson(const SweepResult& result);
/// The command that runs a case again.
std::string commandLine(const Case& given);

}  // namespace penumbra::stress
