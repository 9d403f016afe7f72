// Every chapter's program as an object, none of them listed by hand.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/app/chapter.h"

namespace penumbra {

struct ChapterProgram {
    ChapterInfo info;
    std::function<std::unique_ptr<Chapter>()> make;
};

/// Those that draw with OpenGL, in the order of their numbers.
const std::vector<ChapterProgram>& chapterPrograms();

}  // namespace penumbra
