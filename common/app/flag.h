// One flag of the command line, declared once: parsed, and explained by --help.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/app/chapter.h"
#include "common/app/command_line.h"

namespace penumbra {

struct Flag {
    enum class Value { none, optional, required };
    std::string name;       ///< without dashes
    std::string valueName;  ///< "WxH", "FILE"; "" for a switch
    std::string group;      ///< heading in --help
    std::string help;
    Value value = Value::required;
    std::function<void(const std::string& text)> apply;  ///< throws UsageError
    bool repeatable = false;                             ///< false: the last one counts
};

/// Every flag of a chapter: the common ones, writing into `options`, then one for each parameter; and those
/// of its skips.
std::vector<Flag> chapterFlags(const ChapterInfo& info, Parameters& parameters, Options& options);

/// What --help prints, at most 100 columns wide.
std::string helpText(const ChapterInfo& info, const std::vector<Flag>& flags, const Parameters& parameters);

}  // namespace penumbra
