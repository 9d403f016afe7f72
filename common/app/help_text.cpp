#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/app/flag.h"

namespace penumbra {
namespace {

constexpr std::size_t helpColumns = 100;
constexpr std::size_t helpIndent = 27;

/// "  left        text text", continued under the text.
void appendEntry(std::string& out, const std::string& left, const std::string& text) {
    std::string line = fmt::format("{:<{}}", "  " + left, helpIndent);
    if (left.size() + 3 > helpIndent) {
        out += line + "\n";
        line = std::string(helpIndent, ' ');
    }
    std::istringstream words(text);
    std::size_t wordsInLine = 0;
    for (std::string word; words >> word; ++wordsInLine) {
        if (wordsInLine > 0 && line.size() + 1 + word.size() > helpColumns) {
            out += line + "\n";
            line = std::string(helpIndent, ' ');
            wordsInLine = 0;
        }
        line += (wordsInLine > 0 ? " " : "") + word;
    }
    out += line + "\n";
}

void appendFlags(std::string& out, const std::vector<Flag>& flags) {
    std::string group;
    for (const Flag& flag : flags) {
        if (flag.group != group) out += fmt::format("\n{}\n", flag.group);
        group = flag.group;
        appendEntry(out, "--" + flag.name + (flag.valueName.empty() ? "" : " " + flag.valueName), flag.help);
    }
}

void appendViews(std::string& out, const ChapterInfo& info) {
    out += "\nViews (--view NAME)\n";
    for (const ViewInfo& view : info.views) appendEntry(out, view.name, view.help);
    appendEntry(out, "truth", "the exact answer (with --compare-truth)");
    appendEntry(out, "error", "how far the picture is from it, in false colour (with --compare-truth)");
}

void appendSkips(std::string& out, const std::vector<Skip>& skips) {
    if (skips.empty()) return;
    out += "\nSkips (--no-skip NAME)\n";
    for (const Skip& skip : skips) appendEntry(out, skip.name, skip.help);
}

void appendExamples(std::string& out, const std::string& name, const Parameters& parameters) {
    out += "\nExamples\n";
    out += fmt::format("  {} --scene contact --output out/contact.png\n", name);
    out += fmt::format("  {} --compare-truth --view error --output out/error.png\n", name);
    out += fmt::format("  {} --runs 20 --compare-truth --report out/report.json\n", name);
    const auto& all = parameters.all();
    const auto last =
        std::find_if(all.rbegin(), all.rend(), [](const Parameter& p) { return p.defaultValue.index() < 2; });
    if (last == all.rend()) return;
    const double doubled = 2.0 * (last->defaultValue.index() == 0 ? std::get<int>(last->defaultValue)
                                                                  : std::get<float>(last->defaultValue));
    const bool allowed = doubled >= last->low && doubled <= last->high;
    out += fmt::format("  {} --{} {}\n", name, last->name, shortNumber(allowed ? doubled : last->high));
}

}  // namespace

std::string helpText(const ChapterInfo& info, const std::vector<Flag>& flags, const Parameters& parameters) {
    std::string out = fmt::format("{}: {}\n\n", info.name, info.idea);
    out += fmt::format("Usage: {} [FLAGS]\n", info.name);
    out += "Opens a window to play in. Without a display, or with --headless, renders one picture\n";
    out += fmt::format("(into out/{}.png unless --output or --report says otherwise).\n", info.name);
    appendExamples(out, info.name, parameters);
    appendFlags(out, flags);
    appendViews(out, info);
    appendSkips(out, parameters.skips().all());
    out += "\nEnvironment\n";
    appendEntry(out, "PENUMBRA_ASSETS", "folder of the scenes, instead of assets/");
    appendEntry(out, "PENUMBRA_SHADERS", "folder of the shaders, instead of shaders/");
    appendEntry(out, "PENUMBRA_TRUTH_CACHE", "where exact answers are kept, instead of out/truth-cache");
    out += "\nExit status: 0 fine, 1 the work failed, 2 the command line is wrong.\n";
    return out;
}

}  // namespace penumbra
