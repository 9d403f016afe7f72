// Every chapter, by its number.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/app/chapter.h"

namespace penumbra::stress {

/// A new one of "00" to "11". Throws Error for another.
std::unique_ptr<Chapter> makeChapter(const std::string& number);
/// The views of a chapter, color and visibility among them where it has these.
std::vector<std::string> viewsOf(const std::string& number);

}  // namespace penumbra::stress
