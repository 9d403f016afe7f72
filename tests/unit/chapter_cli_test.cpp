// What every chapter program must do, whatever it teaches.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "common/image/file_write.h"
#include "tests/unit/run_program.h"
#include "tests/unit/triangle_scene.h"

namespace penumbra {
namespace {

using Json = nlohmann::json;

/// The real programs, with what every one of them must do.
class RealChapter : public testing::TestWithParam<std::string> {
 protected:
    RealChapter() { writeFile(folder / "triangle.gltf", triangleFile); }
    ProgramResult run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"--scene", "triangle.gltf"});
        return runProgram({.program = programFolder() / GetParam(),
                           .arguments = std::move(arguments),
                           .folder = folder.path()});
    }
    TemporaryFolder folder;
};

TEST_P(RealChapter, RendersEveryOneOfItsViews) {
    ASSERT_TRUE(std::filesystem::exists(programFolder() / GetParam())) << "build it first";
    const std::string refusal = run({"--view", "?"}).err;
    const std::size_t begin = refusal.find("one of ") + 7;
    std::istringstream names(refusal.substr(begin, refusal.find('\n') - begin));
    for (std::string view; names >> view;) {
        if (view.back() == ',') view.pop_back();
        const ProgramResult result =
            run({"--size", "48x32", "--view", view, "--compare-truth", "--output", view + ".exr", "--quiet"});
        EXPECT_EQ(result.status, 0) << view << ": " << result.err;
        EXPECT_EQ(result.out + result.err, "") << view;
        EXPECT_TRUE(std::filesystem::exists(folder / (view + ".exr"))) << view;
    }
}

TEST_P(RealChapter, RendersTheSameFileTwice) {
    for (const char* extension : {".png", ".exr"}) {
        std::vector<std::string> pictures;
        for (const char* name : {"a", "b"}) {
            ASSERT_EQ(run({"--size", "48x32", "--output", std::string(name) + extension, "--quiet"}).status,
                      0);
            pictures.push_back(bytesOf(folder / (std::string(name) + extension)));
        }
        EXPECT_FALSE(pictures[0].empty());
        EXPECT_TRUE(pictures[0] == pictures[1]) << extension;
    }
}

TEST_P(RealChapter, RendersOnePixelAndOneLine) {
    for (const char* size : {"1x1", "1x777"}) {
        const ProgramResult result = run({"--size", size, "--output", "a.png"});
        EXPECT_EQ(result.status, 0) << size << ": " << result.err;
    }
}

TEST_P(RealChapter, RefusesEveryParameterOutsideItsRange) {
    for (const Json& parameter : Json::parse(run({"--list-parameters"}).out)) {
        const std::string name = parameter["name"];
        EXPECT_FALSE(parameter["help"].get<std::string>().empty()) << name;
        for (const char* bad : {"nan", "-1e30", "no-such-value"}) {
            const ProgramResult result = run({"--" + name, bad});
            EXPECT_EQ(result.status, 2) << name << " " << bad;
            EXPECT_EQ(result.errorLines(), 1) << result.err;
        }
    }
}

/// Those of the source tree: a new one is tested without being listed here.
std::vector<std::string> chapterNames() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(PENUMBRA_SOURCE_DIR "/chapters"))
        if (std::filesystem::exists(entry.path() / "main.cpp"))
            names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// What a benchmark counts as the price of a bake: no timed frame makes it again.
TEST(ChapterWithABake, ReportsThePassThatOnlyTheFirstFrameMakes) {
    const TemporaryFolder folder;
    writeFile(folder / "triangle.gltf", triangleFile);
    const ProgramResult result =
        runProgram({.program = programFolder() / "09_ambient_occlusion",
                    .arguments = {"--scene", "triangle.gltf", "--method", "vertices", "--size", "16x16",
                                  "--runs", "2", "--pass-times", "--report", "r.json", "--quiet"},
                    .folder = folder.path()});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json passes = Json::parse(bytesOf(folder / "r.json"))["time"]["passes_ms"];
    EXPECT_EQ(passes["bake"]["runs"], 1);
    EXPECT_EQ(passes["picture"]["runs"], 2);
}

INSTANTIATE_TEST_SUITE_P(Chapters, RealChapter, testing::ValuesIn(chapterNames()),
                         [](const auto& chapter) { return "C" + chapter.param; });

}  // namespace
}  // namespace penumbra
