// "Did you mean ...?"
#pragma once

#include <string>
#include <vector>

namespace penumbra {

/// The candidate nearest to `name` by edit distance, or "" if none is near enough to be what was meant.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

/// "; did you mean NAME?" or "".
std::string didYouMean(const std::string& name, const std::vector<std::string>& candidates);

/// "a, b, c".
std::string joinNames(const std::vector<std::string>& names);

}  // namespace penumbra
