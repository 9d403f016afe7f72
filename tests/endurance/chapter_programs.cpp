// Each chapter's main.cpp is compiled once more with another name for its main (CMakeLists.txt), and linked
// with the runChapter below in place of the real one: called, it hands over what it would have run.
#include "tests/endurance/chapter_programs.h"

#include <chapter_mains.h>  // generated: declarations, and MAINS, the functions

namespace penumbra {
namespace {

std::vector<ChapterProgram>& found() {
    static std::vector<ChapterProgram> programs;
    return programs;
}

}  // namespace

int runChapter(const ChapterInfo& info, const std::function<std::unique_ptr<Chapter>()>& make, int, char**) {
    if (info.needsGl) found().push_back({info, make});
    return 0;
}

const std::vector<ChapterProgram>& chapterPrograms() {
    if (found().empty())
        for (const auto main : {MAINS}) main(0, nullptr);
    return found();
}

}  // namespace penumbra
