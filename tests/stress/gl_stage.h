// Chapters with their programs compiled, on which one small scene after the other is shown.
#pragma once

#include <memory>
#include <string>

#include "tests/image/chapter_harness.h"

namespace penumbra::stress {

/// The chapter `number` with `scene`. Compiling takes longer than drawing a hundred small pictures, so
/// chapters are kept, one for each `programs`: name in it whatever a chapter compiles programs for (06 and
/// 07: kind of light, format). Draw each scene that is shown: an address may come back after two. Parameters
/// keep the values of the case before: set all that matter. Valid until the next call for the same chapter
/// and programs.
ChapterHarness& shown(const std::string& number, const std::string& programs, Scene scene);

/// The first value that is no finite number, as text; empty: there is none.
std::string notFinite(const FloatImage& picture);

}  // namespace penumbra::stress
