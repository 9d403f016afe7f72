#include "common/app/skips.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra {

void Skips::declare(const Skip& skip) {
    for (const Entry& entry : entries_) {
        if (entry.skip == &skip) return;
        if (std::string(entry.skip->name) == skip.name)
            throw Error(fmt::format("two skips are named {}", skip.name));
    }
    entries_.push_back({&skip});
}

bool Skips::operator()(const Skip& skip) const {
    for (const Entry& entry : entries_)
        if (entry.skip == &skip) return entry.on;
    throw Error(fmt::format("the chapter skips {} and does not declare it", skip.name));
}

void Skips::switchOff(const std::string& name) {
    std::vector<std::string> names;
    for (Entry& entry : entries_) {
        if (name == entry.skip->name) {
            entry.on = false;
            return;
        }
        names.emplace_back(entry.skip->name);
    }
    if (names.empty()) throw UsageError(fmt::format("--no-skip {}: this chapter skips nothing", name));
    throw UsageError(fmt::format("--no-skip {}: must be one of {}{}", name.empty() ? "\"\"" : name,
                                 joinNames(names), didYouMean(name, names)));
}

void Skips::switchAllOff() {
    for (Entry& entry : entries_) entry.on = false;
}

std::vector<Skip> Skips::all() const {
    std::vector<Skip> skips;
    for (const Entry& entry : entries_) skips.push_back(*entry.skip);
    return skips;
}

std::vector<std::string> Skips::off() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_)
        if (!entry.on) names.emplace_back(entry.skip->name);
    return names;
}

bool Skips::allOff() const {
    return !entries_.empty() && off().size() == entries_.size();
}

std::string Skips::toJson() const {
    nlohmann::ordered_json list = nlohmann::json::array();
    for (const Entry& entry : entries_)
        list.push_back(
            {{"name", entry.skip->name}, {"counter", entry.skip->counter}, {"help", entry.skip->help}});
    return list.dump(2);
}

}  // namespace penumbra
