#include "common/app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "common/app/flag.h"
#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra {
namespace {

/// Hands the flags to CLI11. Values arrive as text: our own parsing gives every mistake the same kind of
/// message.
void addToParser(CLI::App& parser, const std::vector<Flag>& flags) {
    parser.set_help_flag();
    parser.allow_extras();
    for (const Flag& flag : flags) {
        const auto apply = [&flag](const CLI::results_t& texts) {
            if (flag.repeatable)
                for (const std::string& text : texts) flag.apply(text);
            else
                flag.apply(texts.empty() ? "" : texts.back());
            return true;
        };
        if (flag.value == Flag::Value::none) {
            parser.add_flag_callback("--" + flag.name, [&flag] {
                if (flag.apply) flag.apply("");
            });
            continue;
        }
        CLI::Option* option = parser.add_option("--" + flag.name, CLI::callback_t(apply));
        option->expected(flag.value == Flag::Value::optional ? 0 : 1, 1);
        option->multi_option_policy(flag.repeatable ? CLI::MultiOptionPolicy::TakeAll
                                                    : CLI::MultiOptionPolicy::TakeLast);
    }
}

std::string withoutDashes(const std::string& argument) {
    const std::string name = argument.substr(std::min(argument.find_first_not_of('-'), argument.size()));
    return name.substr(0, name.find('='));
}

[[noreturn]] void refuseUnknown(const std::string& argument, const std::vector<Flag>& flags) {
    if (argument.rfind('-', 0) != 0)
        throw UsageError(fmt::format(
            "{}: not expected here; every argument is a --flag or its value (--help lists them)", argument));
    std::vector<std::string> names;
    for (const Flag& flag : flags) names.push_back("--" + flag.name);
    throw UsageError(fmt::format("{}: unknown flag{} (--help lists them all)",
                                 argument.substr(0, argument.find('=')),
                                 didYouMean("--" + withoutDashes(argument), names)));
}

/// CLI11 would take "--quiet=off" and "--help=3" as it pleases.
void refuseValuesOfSwitches(const std::vector<Flag>& flags, int argc, const char* const* argv) {
    for (const Flag& flag : flags) {
        if (flag.value != Flag::Value::none) continue;
        const std::string begin = "--" + flag.name + "=";
        for (int i = 1; i < argc; ++i)
            if (std::string(argv[i]).rfind(begin, 0) == 0)
                throw UsageError(fmt::format("{}: --{} takes no value", argv[i], flag.name));
    }
}

void parseFlags(const std::vector<Flag>& flags, int argc, const char* const* argv) {
    refuseValuesOfSwitches(flags, argc, argv);
    CLI::App parser;
    addToParser(parser, flags);
    try {
        parser.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // What is left for CLI11 to find: a flag without its value. Its message begins with the flag.
        const std::string text = error.what();
        throw UsageError(
            fmt::format("{}: needs a value; see --help", text.substr(0, text.find_first_of(": "))));
    }
    const std::vector<std::string> unknown = parser.remaining();
    if (!unknown.empty()) refuseUnknown(unknown.front(), flags);
}

bool asksFor(const char* flag, int argc, const char* const* argv) {
    return std::any_of(argv + 1, argv + argc,
                       [&](const char* argument) { return std::string(argument) == flag; });
}

/// Mistakes that only two flags together can make.
void requireConsistent(const Options& o) {
    if ((o.view == "truth" || o.view == "error") && !o.compareTruth)
        throw UsageError(
            fmt::format("--view {}: needs --compare-truth, which computes the exact answer", o.view));
    if (o.headless && o.backend == Backend::window)
        throw UsageError("--backend window: contradicts --headless; leave one of them out");
    if (std::max(o.size.x, o.size.y) * o.antialias > largestSize)
        throw UsageError(fmt::format(
            "--antialias {}: {}x{} pixels would be rendered, more than {}x{}; use less of either",
            o.antialias, o.size.x * o.antialias, o.size.y * o.antialias, largestSize, largestSize));
}

void deriveHeadless(Options& o) {
    const bool wantsFigures = o.compareTruth || o.passTimes || o.still || o.runs > 1;
    if (!o.output.empty() || !o.report.empty() || wantsFigures) o.headless = true;
    if (o.backend == Backend::osmesa || o.backend == Backend::egl) o.headless = true;
}

}  // namespace

glm::ivec2 parseSize(const std::string& text) {
    glm::ivec2 size{0};
    const char* end = text.data() + text.size();
    const auto [afterWidth, widthError] = std::from_chars(text.data(), end, size.x);
    const bool cross = widthError == std::errc() && afterWidth != end && *afterWidth == 'x';
    const auto [afterHeight, heightError] = std::from_chars(cross ? afterWidth + 1 : end, end, size.y);
    const bool read = cross && heightError == std::errc() && afterHeight == end;
    if (!read || size.x < 1 || size.y < 1 || size.x > largestSize || size.y > largestSize)
        throw UsageError(
            fmt::format("--size {}: must be WIDTHxHEIGHT in pixels, from 1x1 to {}x{}, such as 512x512",
                        text.empty() ? "\"\"" : text, largestSize, largestSize));
    return size;
}

std::optional<Options> parseCommandLine(const ChapterInfo& info, Parameters& parameters, int argc,
                                        const char* const* argv) {
    Options options;
    const std::vector<Flag> flags = chapterFlags(info, parameters, options);
    if (asksFor("--help", argc, argv) || asksFor("-h", argc, argv)) {
        fmt::print("{}", helpText(info, flags, parameters));
        return std::nullopt;
    }
    parseFlags(flags, argc, argv);
    if (asksFor("--version", argc, argv)) {
        fmt::print("{} (Penumbra {})\n", info.name, versionText);
        return std::nullopt;
    }
    if (asksFor("--list-skips", argc, argv)) {
        fmt::print("{}\n", parameters.skips().toJson());
        return std::nullopt;
    }
    if (asksFor("--list-parameters", argc, argv)) {
        fmt::print("{}\n", parameters.toJson(false));
        return std::nullopt;
    }
    requireConsistent(options);
    deriveHeadless(options);
    return options;
}

}  // namespace penumbra
