// Work that is left out changes no bit of any picture, and chapter 07 draws chapter 06's.
#include <fmt/format.h>

#include "tests/stress/any_scene.h"
#include "tests/stress/chapters.h"
#include "tests/stress/gl_stage.h"

namespace penumbra::stress {
namespace {

/// Values that differ; NaNs differ from everything.
void expectSame(Verdict& verdict, const char* what, const FloatImage& a, const FloatImage& b) {
    verdict.expectAtMost(what, double(differing(a, b)), 0.0);
}

Verdict checkSkips(const Case& given) {
    Verdict verdict;
    const std::string chapter = given.choice("chapter");
    ChapterHarness& harness = shown(chapter, programsOf(given), anyScene(given));
    harness.set(settingsOf(given));
    const glm::ivec2 size(given.integer("picture"));
    const std::string view = viewsOf(chapter)[std::size_t(given.integer("variant")) % 2];
    harness.skip = true;
    const FloatImage skipped = harness.picture(view, size, 3);
    harness.skip = false;
    expectSame(verdict, "values that --skip-none changes", harness.picture(view, size, 3), skipped);
    return verdict;
}

Verdict checkBranching(const Case& drawn) {
    Verdict verdict;
    Case given = drawn;
    given.values["chapter"] = axisNamed("chapter").parse("07");
    Settings settings = settingsOf(given);
    const int variant = given.integer("variant");
    settings.emplace_back("receiver-plane", variant % 3 == 0 ? "false" : "true");
    settings.emplace_back("bias", variant % 5 == 0 ? "0" : "1");
    settings.emplace_back("fit", variant % 2 == 0 ? "view" : "scene");
    const std::string programs =
        programsOf(given) + fmt::format(" {} {}", variant % 3 == 0, variant % 5 == 0);
    const glm::ivec2 size(given.integer("picture"));
    const auto picture = [&](const std::string& chapter) {
        ChapterHarness& harness = shown(chapter, programs, anyScene(given));
        harness.set(settings);
        return harness.scalar("visibility", size);
    };
    expectSame(verdict, "values in which 07 differs from 06", picture("07"), picture("06"));
    return verdict;
}

const AddSubject skips({.name = "skips",
                        .claim = "--skip-none changes no bit of any chapter's picture",
                        .axes = anySceneAxes,
                        .check = checkSkips,
                        .share = 0.25});
const AddSubject branching({.name = "branching",
                            .claim = "what the minimum and maximum map lets 07 skip changes no bit of 06",
                            .axes = {"light-type", "depth-format", "shape", "light-angle", "scale",
                                     "distance", "aside", "fov", "map-size", "picture", "radius", "variant"},
                            .check = checkBranching,
                            .share = 0.15});

}  // namespace
}  // namespace penumbra::stress
