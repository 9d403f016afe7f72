// Numerical stress: what must hold, tried on thousands of cases; a failing one is shrunk and can be run
// again.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "common/app/progress.h"
#include "common/error.h"
#include "common/image/file_write.h"
#include "tests/stress/sweep.h"

using namespace penumbra;
using namespace penumbra::stress;

namespace {

volatile std::sig_atomic_t interrupted = 0;

/// The first Ctrl-C ends the sweep after the case at hand, and what was done is printed; the second ends the
/// program.
extern "C" void remember(int signal) {
    interrupted = 1;
    std::signal(signal, SIG_DFL);
}

struct Options {
    std::uint64_t cases = 0, seed = 1;  ///< 0 cases: not given
    std::vector<const Subject*> subjects;
    std::string report, kept;
    std::vector<std::string> ofOneCase;    ///< --subject and flags of axes
    std::map<std::string, double> pinned;  ///< axes given: without --cases, it is one case
    bool help = false;
};

std::string columns(const std::string& flag, const std::string& help) {
    return fmt::format("  {:<28} {}\n", flag, help);
}

std::string axisHelp(const Axis& axis) {
    if (axis.kind == Axis::Kind::choice) {
        std::string choices;
        for (const std::string& choice : axis.choices) choices += (choices.empty() ? "" : "|") + choice;
        return columns("--" + axis.name, fmt::format("{}: {}", axis.help, choices));
    }
    return columns("--" + axis.name, fmt::format("{}: {:g} to {:g}{}{}{}; simplest {:g}", axis.help, axis.low,
                                                 axis.high, axis.unit.empty() ? "" : " ", axis.unit,
                                                 axis.orZero ? ", or 0" : "", axis.simplest));
}

std::string helpText() {
    std::string text =
        "stress: numerical stress. Draws cases by a seed, half of them anywhere in their ranges, half at the "
        "ends,\n"
        "at powers of two and just beside them; checks what must hold; shrinks what fails to its simplest "
        "form.\n\n"
        "  stress --cases 2000                        a sweep over all subjects\n"
        "  stress --cases 500 --subject bias          over one\n"
        "  stress --subject bias --light-angle 89.2   one case; axes that are not given are at their "
        "simplest\n\n"
        "Of a sweep:\n";
    text += columns("--cases N", "how many, over all subjects (default 2000)");
    text += columns("--seed S", "another seed, other cases; the same seed, the same cases (default 1)");
    text += columns("--subject NAME", "only this one; may be given several times");
    text += columns("--report FILE", "results as JSON, of which tools/stress_page.py makes a page");
    text +=
        columns("--kept FILE", "first runs the cases of this file: a line of flags each, # begins a remark");
    text += "\nSubjects, and what must hold:\n";
    for (const Subject& subject : allSubjects()) text += columns(subject.name, subject.claim);
    text += "\nAxes, of a single case:\n";
    for (const Axis& axis : allAxes()) text += axisHelp(axis);
    return text +
           "\nExit status: 0 everything held, 1 something failed, 2 the command line is wrong, 130 "
           "interrupted.\n";
}

std::uint64_t wholeNumber(const std::string& flag, const std::string& text) {
    const bool digits =
        !text.empty() && text.size() < 16 && text.find_first_not_of("0123456789") == std::string::npos;
    if (!digits) throw UsageError(fmt::format("{} {}: must be a whole number from 0", flag, text));
    return std::stoull(text);
}

Options parse(const std::vector<std::string>& words) {
    Options options;
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string& flag = words[i];
        if (flag == "--help" || flag == "-h") options.help = true;
        if (options.help) return options;
        if (i + 1 == words.size())
            throw UsageError(fmt::format("{}: needs a value; stress --help explains", flag));
        const std::string& value = words[i + 1];
        if (flag == "--cases") {
            options.cases = wholeNumber(flag, value);
        } else if (flag == "--seed") {
            options.seed = wholeNumber(flag, value);
        } else if (flag == "--report") {
            options.report = value;
        } else if (flag == "--kept") {
            options.kept = value;
        } else {
            options.ofOneCase.insert(options.ofOneCase.end(), {flag, value});
            if (flag == "--subject") {
                options.subjects.push_back(&subjectNamed(value));
            } else {
                const std::string name = flag.starts_with("--") ? flag.substr(2) : flag;
                options.pinned[name] = axisNamed(name).parse(value);
            }
        }
    }
    if (options.subjects.empty())
        for (const Subject& subject : allSubjects()) options.subjects.push_back(&subject);
    return options;
}

/// True when it held.
bool tryCase(const Case& given) {
    const Verdict verdict = verdictOn(subjectNamed(given.subject), given);
    if (verdict.failure) fmt::print("FAILED {}\n  {}\n", *verdict.failure, commandLine(given));
    return !verdict.failure;
}

int runOneCase(const std::vector<std::string>& flags) {
    const Case given = caseFrom(flags);
    const Verdict verdict = verdictOn(subjectNamed(given.subject), given);
    fmt::print("{}\n", commandLine(given));
    for (const auto& [name, value] : verdict.measured) fmt::print("  {:<34} {:.6g}\n", name, value);
    if (verdict.refusal) fmt::print("  refused: {}\n", *verdict.refusal);
    fmt::print("{}\n", verdict.failure ? "FAILED " + *verdict.failure : "held");
    return verdict.failure ? exitFailed : exitFine;
}

std::size_t runKept(const std::string& file) {
    std::ifstream stream(file);
    if (!stream) throw Error(fmt::format("{}: cannot be read", file));
    std::size_t failed = 0;
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::vector<std::string> flags;
        for (std::string word; words >> word;) flags.push_back(word);
        if (!flags.empty()) failed += !tryCase(caseFrom(flags));
    }
    return failed;
}

int runSweep(const Options& options) {
    if (!options.report.empty()) requireWritable(options.report);
    std::signal(SIGINT, remember);
    std::signal(SIGTERM, remember);
    const std::size_t failedAgain = options.kept.empty() ? 0 : runKept(options.kept);
    Progress progress(false);
    progress.start("stress");
    SweepRequest request{.subjects = options.subjects};
    request.cases = options.cases ? options.cases : request.cases;
    request.seed = options.seed;
    request.pinned = options.pinned;
    request.progress = progress.callback();
    request.stop = [] { return interrupted != 0; };
    request.say = [&progress](const std::string& line) {
        progress.finish();
        fmt::print("{}\n", line);
        std::fflush(stdout);
    };
    const SweepResult result = sweep(request);
    progress.finish();
    fmt::print("{}", summaryOf(result));
    if (!options.report.empty()) writeFile(options.report, reportJson(result));
    if (result.interrupted) return 130;
    return result.failed + failedAgain ? exitFailed : exitFine;
}

int run(const std::vector<std::string>& words) {
    const Options options = parse(words);
    if (options.help) {
        fmt::print("{}", helpText());
        return exitFine;
    }
    return options.pinned.empty() || options.cases ? runSweep(options) : runOneCase(options.ofOneCase);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const Error& error) {
        fmt::print(stderr, "stress: {}\n", error.what());
        return error.status();
    } catch (const std::exception& problem) {
        fmt::print(stderr, "stress: {}\n", problem.what());
        return exitFailed;
    }
}
