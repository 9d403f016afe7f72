// No picture of any chapter holds a value that is no number, whatever the scene.
#include <fmt/format.h>

#include "tests/stress/any_scene.h"
#include "tests/stress/chapters.h"
#include "tests/stress/gl_stage.h"

namespace penumbra::stress {
namespace {

Verdict check(const Case& given) {
    Verdict verdict;
    const std::string chapter = given.choice("chapter");
    ChapterHarness& harness = shown(chapter, programsOf(given), anyScene(given));
    harness.set(settingsOf(given));
    const glm::ivec2 size(given.integer("picture"));
    const std::vector<std::string> views = viewsOf(chapter);
    const std::string& view = views[std::size_t(given.integer("variant")) % views.size()];
    const std::string found = notFinite(harness.picture(view, size, 3));
    if (!found.empty()) verdict.fail(fmt::format("--view {}: {}", view, found));
    return verdict;
}

const AddSubject finite({.name = "finite-pictures",
                         .claim = "no view of any chapter holds a NaN or an infinity, whatever the scene",
                         .axes = anySceneAxes,
                         .check = check,
                         .share = 0.25});

}  // namespace
}  // namespace penumbra::stress
