// runChapter from the outside: every flag, one mistake of each kind, and what is left behind. A tiny chapter
// with a known answer is part of this program: called with "--as-chapter" it is that chapter.
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/app/chapter.h"
#include "common/error.h"
#include "common/image/file_write.h"
#include "common/image/image_file.h"
#include "tests/unit/run_program.h"
#include "tests/unit/triangle_scene.h"

namespace penumbra {
namespace {

using Json = nlohmann::json;

constexpr Skip half{"half", "", "half of it is known"};
constexpr Skip rest{"rest", "", "the other half is known too"};

/// visibility: 1 right of the middle, else 0, plus `offset`; its exact answer has no offset and none for the
/// top row.
class TinyChapter : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        parameters.add("offset", offset_, -4.0f, 4.0f, "", "added to the visibility");
        parameters.add("seconds", seconds_, 0, 60, "s", "how long a frame takes");
        parameters.add("fault", fault_, {"none", "error", "memory", "unknown", "crash"}, "what goes wrong");
        for (const Skip* skip : {&half, &rest}) parameters.skips().declare(*skip);
    }
    void load(const Scene&, const Context*) override {}
    void render(const Frame& frame) override {
        PassScope scope(frame.passTimer, "only");
        if (seconds_ > 0) writeFile("started", "");
        for (int i = 0; i < 20 * seconds_; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            frame.progress((i + 1) / (20.0 * seconds_));
        }
        if (fault_ == "error") throw Error("the chapter failed; do otherwise");
        if (fault_ == "memory") throw std::bad_alloc();
        if (fault_ == "crash") std::raise(SIGSEGV);
        if (fault_ == "unknown") throw std::out_of_range("something else");
        frame.work["frames"] += 1;
        frame.work["maps"] += frame.renderMapsAgain ? 1 : 0;
        for (const Skip* skip : {&half, &rest}) frame.work[skip->name] += frame.skips(*skip) ? 1 : 0;
        const bool scalar = frame.view == "visibility";
        *frame.cpuPicture = FloatImage(frame.size.x, frame.size.y, scalar ? 1 : 3, 0.25f);
        if (scalar) *frame.cpuPicture = step(frame.size, offset_);
    }
    TruthImage truth(const TruthRequest& request) override {
        if (request.view != "visibility") throw UsageError("no exact answer");
        TruthImage truth;
        truth.value = step(request.size, 0.0f);
        truth.mask = FloatImage(request.size.x, request.size.y, 1, 1.0f);
        for (int x = 0; x < request.size.x; ++x) truth.mask.at(x, 0) = 0.0f;
        truth.quantity = "visibility";
        truth.method = "closed form";
        truth.against = "point light";
        truth.background = std::size_t(request.size.x);
        return truth;
    }

 private:
    static FloatImage step(const glm::ivec2& size, float offset) {
        FloatImage image(size.x, size.y, 1);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) image.at(x, y) = (2 * x >= size.x ? 1.0f : 0.0f) + offset;
        return image;
    }
    float offset_ = 0.0f;
    int seconds_ = 0;
    std::string fault_ = "none";
};

class Cli : public testing::Test {
 protected:
    Cli() { writeTextFile(folder / "triangle.gltf", triangleFile); }
    ProgramCall call(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"--as-chapter", "--scene", "triangle.gltf"});
        return {.program = programFolder() / "unit_cli",
                .arguments = std::move(arguments),
                .folder = folder.path()};
    }
    ProgramResult run(const std::vector<std::string>& arguments) const { return runProgram(call(arguments)); }
    /// Files besides the scene.
    std::size_t filesLeft() const { return folder.entries() - 1; }
    void expectRefusal(const std::vector<std::string>& arguments, int status, const std::string& part) const {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.status, status) << part;
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_EQ(result.err.rfind("99_tiny: ", 0), 0u) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(filesLeft(), 0u) << result.err;
    }
    TemporaryFolder folder;
};

TEST_F(Cli, WithoutADisplayAPictureGoesToOutAndTheSummarySaysSo) {
    const ProgramResult result = run({});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find("out/99_tiny.png"), std::string::npos) << result.out;
    EXPECT_EQ(readImage(folder / "out/99_tiny.png").width, 512);
    EXPECT_EQ(filesLeft(), 2u);
}

TEST_F(Cli, QuietPrintsNothing) {
    const ProgramResult result = run({"--quiet", "--seconds", "2", "--size", "8x8"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Cli, WorkOfMoreThanASecondShowsProgressInPlainLines) {
    const ProgramResult result = run({"--seconds", "2", "--size", "8x8"});
    EXPECT_NE(result.err.find("rendering: 100 %"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("rendering: 10 %"), std::string::npos) << "nothing in the first second";
    EXPECT_EQ(result.err.find('\r'), std::string::npos);
}

TEST_F(Cli, TheReportHoldsTheErrorAgainstTheKnownAnswer) {
    const ProgramResult result = run({"--compare-truth", "--offset", "0.25", "--size", "10x8", "--report",
                                      "new/r.json", "--runs", "3", "--pass-times"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json report = Json::parse(bytesOf(folder / "new/r.json"));
    EXPECT_EQ(report["size"], Json::parse("[10, 8]"));
    EXPECT_EQ(report["parameters"]["offset"], 0.25);
    EXPECT_EQ(report["time"]["frame_ms"]["runs"], 3);
    EXPECT_EQ(report["time"]["passes_ms"]["only"]["runs"], 3);
    EXPECT_EQ(report["work"]["frames"], 1) << "work is that of one frame";
    EXPECT_EQ(report["work"]["maps"], 1) << "a timed frame pays for its maps";
    EXPECT_EQ(report["error"]["pixels"], 70);
    EXPECT_EQ(report["error"]["excluded"]["pixels"], 10);
    EXPECT_EQ(report["error"]["excluded"]["background"], 10);
    EXPECT_EQ(report["error"]["rmse"], 0.25);
    EXPECT_EQ(report["error"]["bias"], 0.25);
    EXPECT_EQ(filesLeft(), 2u);
}

TEST_F(Cli, StillAndSkipNoneReachTheChapter) {
    const ProgramResult result = run({"--report", "-", "--still", "--skip-none", "--size", "4x4"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json report = Json::parse(result.out);
    EXPECT_EQ(report["work"]["maps"], 0);
    EXPECT_EQ(report["work"]["half"], 0);
    EXPECT_EQ(report["work"]["rest"], 0);
    EXPECT_EQ(report["skip"], false);
    EXPECT_EQ(report["skips_off"], Json::parse(R"(["half", "rest"])"));
}

TEST_F(Cli, OneSkipIsSwitchedOffAloneAndAMisspeltOneRefused) {
    const ProgramResult result = run({"--report", "-", "--no-skip", "rest", "--size", "4x4"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json report = Json::parse(result.out);
    EXPECT_EQ(report["work"]["half"], 1);
    EXPECT_EQ(report["work"]["rest"], 0);
    EXPECT_EQ(report["skip"], true) << "not all of them are off";
    EXPECT_EQ(report["skips_off"], Json::parse(R"(["rest"])"));
    expectRefusal({"--no-skip", "rests"}, 2,
                  "--no-skip rests: must be one of half, rest; did you mean rest?");
    EXPECT_EQ(Json::parse(run({"--list-skips"}).out)[1]["help"], rest.help);
}

TEST_F(Cli, TruthAndErrorAreViews) {
    const std::vector<std::string> common{"--compare-truth", "--offset", "0.25", "--size", "8x8", "--quiet"};
    const auto with = [&](const std::string& view, const std::string& file) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {"--view", view, "--output", file});
        return run(arguments).status;
    };
    EXPECT_EQ(with("truth", "t.exr"), 0);
    EXPECT_EQ(with("error", "e.exr"), 0);
    EXPECT_EQ(with("truth", "t.png"), 0);
    EXPECT_EQ(with("error", "e.png"), 0);
    const FloatImage truth = readImage(folder / "t.exr");
    EXPECT_TRUE(std::isnan(truth.at(0, 0))) << "undefined";
    EXPECT_EQ(truth.at(0, 1), 0.0f);
    EXPECT_EQ(truth.at(7, 1), 1.0f);
    const FloatImage error = readImage(folder / "e.exr");
    EXPECT_EQ(error.at(3, 5), 0.25f);
    EXPECT_TRUE(std::isnan(error.at(3, 0)));
    const FloatImage shown = readImage(folder / "t.png");
    EXPECT_EQ(shown.at(7, 1, 1), 1.0f);
    EXPECT_EQ(shown.at(7, 0, 0), shown.at(7, 0, 2)) << "grey where undefined";
    EXPECT_NE(readImage(folder / "e.png").at(3, 5, 0), readImage(folder / "e.png").at(3, 5, 2));
}

TEST_F(Cli, AntialiasAveragesAndExposureIsInStops) {
    ASSERT_EQ(
        run({"--view", "visibility", "--size", "5x1", "--antialias", "4", "--output", "a.exr", "--quiet"})
            .status,
        0);
    const FloatImage smooth = readImage(folder / "a.exr");
    EXPECT_EQ(smooth.values, (std::vector<float>{0, 0, 0.5f, 1, 1}))
        << "the edge runs through the middle pixel";
    ASSERT_EQ(run({"--size", "1x1", "--exposure", "auto", "--output", "auto.png", "--quiet"}).status, 0);
    ASSERT_EQ(run({"--size", "1x1", "--exposure", "-2", "--output", "dark.png", "--quiet"}).status, 0);
    ASSERT_EQ(run({"--size", "1x1", "--exposure", "-2", "--output", "same.exr", "--quiet"}).status, 0);
    EXPECT_LT(readImage(folder / "dark.png").at(0, 0), 0.5f * readImage(folder / "auto.png").at(0, 0));
    EXPECT_EQ(readImage(folder / "same.exr").at(0, 0), 0.25f) << "linear files are never tone-mapped";
}

TEST_F(Cli, TwoRunsGiveIdenticalFiles) {
    for (const char* name : {"a.png", "b.png", "a.exr", "b.exr"})
        ASSERT_EQ(run({"--output", name, "--size", "32x32", "--quiet"}).status, 0);
    EXPECT_TRUE(bytesOf(folder / "a.png") == bytesOf(folder / "b.png"));
    EXPECT_TRUE(bytesOf(folder / "a.exr") == bytesOf(folder / "b.exr"));
}

TEST_F(Cli, QuestionsAreAnsweredOnStandardOutput) {
    const Json parameters = Json::parse(run({"--list-parameters"}).out);
    ASSERT_EQ(parameters.size(), 3u);
    EXPECT_EQ(parameters[0]["name"], "offset");
    EXPECT_NE(run({"--help"}).out.find("Exit status"), std::string::npos);
    EXPECT_EQ(run({"--version"}).out.rfind("99_tiny", 0), 0u);
    EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(Cli, AWrongCommandLineIsStatusTwoAndOneLine) {
    expectRefusal({"--size", "0x0"}, 2, "--size 0x0: must be");
    expectRefusal({"--size", "100000x100000"}, 2, "16384x16384");
    expectRefusal({"--offset", "nan"}, 2, "--offset nan: must be a number from -4 to 4");
    expectRefusal({"--offset", "inf"}, 2, "--offset inf");
    expectRefusal({"--view", "visiblity"}, 2, "did you mean visibility?");
    expectRefusal({"--ofset", "1"}, 2, "did you mean --offset?");
    expectRefusal({"--fault", "nune"}, 2, "did you mean none?");
    expectRefusal({"--camera", "5"}, 2, "--camera 5: triangle has 1 camera");
    expectRefusal({"--view", "error"}, 2, "needs --compare-truth");
    expectRefusal({"--output", "a.gif"}, 2, ".png");
    expectRefusal({"--scene", "no_such_scene"}, 2, "no_such_scene");
    expectRefusal({"--scene", "missing.glb"}, 2, "missing.glb");
}

TEST_F(Cli, WorkThatFailsIsStatusOneAndOneLineAndLeavesNothing) {
    expectRefusal({"--fault", "error"}, 1, "the chapter failed");
    expectRefusal({"--fault", "memory"}, 1, "not enough memory");
    expectRefusal({"--fault", "unknown"}, 1, "something else");
    expectRefusal({"--output", "/proc/penumbra/a.png"}, 1, "/proc/penumbra/a.png: cannot be written");
    expectRefusal({"--output", "triangle.gltf/a.png"}, 1, "cannot be written");
    expectRefusal({"--report", "/dev/full", "--size", "4x4"}, 1, "No space left");
    expectRefusal({"--report", folder.path().string()}, 1, "it is a folder");
    expectRefusal({"--fault", "error", "--output", "new/folder/a.png"}, 1, "failed");
}

TEST_F(Cli, AFileThatCannotBeWrittenIsNamedBeforeTheWorkBegins) {
    expectRefusal({"--report", "triangle.gltf/r.json", "--seconds", "1"}, 1,
                  "triangle.gltf/r.json: cannot be written");
    expectRefusal({"--output", "triangle.gltf/a.png", "--seconds", "1"}, 1,
                  "triangle.gltf/a.png: cannot be written");
}

TEST_F(Cli, AFullStandardOutputIsAFailure) {
    ProgramCall full = call({"--report", "-", "--size", "4x4"});
    full.standardOutput = "/dev/full";
    const ProgramResult result = runProgram(full);
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
}

TEST_F(Cli, AFailedRunLeavesTheOldPictureAsItWas) {
    writeTextFile(folder / "a.png", "the old picture");
    EXPECT_EQ(run({"--fault", "error", "--output", "a.png"}).status, 1);
    EXPECT_EQ(bytesOf(folder / "a.png"), "the old picture");
    EXPECT_EQ(filesLeft(), 1u);
}

TEST_F(Cli, CtrlCEndsWithOneLineAndNoFiles) {
    for (const int signal : {SIGINT, SIGTERM}) {
        ProgramCall interrupted = call({"--seconds", "60", "--quiet", "--output", "a.png"});
        interrupted.signal = signal;
        interrupted.signalWhen = [this] { return std::filesystem::exists(folder / "started"); };
        const ProgramResult result = runProgram(interrupted);
        EXPECT_EQ(result.status, 128 + signal);
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_TRUE(std::filesystem::remove(folder / "started"));
        EXPECT_EQ(filesLeft(), 0u);
    }
}

TEST_F(Cli, AFileLargerThanAllowedIsAFailureThatLeavesTheOldPicture) {
    for (const char* name : {"a.png", "a.exr"}) {
        writeTextFile(folder / name, "the old picture");
        ProgramCall limited = call({"--size", "700x700", "--quiet", "--output", name});
        limited.largestFile = 100;
        const ProgramResult result = runProgram(limited);
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.errorLines(), 1) << result.err;
        EXPECT_NE(result.err.find("File too large"), std::string::npos) << result.err;
        EXPECT_EQ(bytesOf(folder / name), "the old picture");
        std::filesystem::remove(folder / name);
        EXPECT_EQ(filesLeft(), 0u);
    }
}

#ifndef PENUMBRA_SANITIZED  // which takes 20 TB of address space, and handles crashes itself
TEST_F(Cli, UnderALimitOfMemoryACrashIsOneLineAndWithoutOneACrash) {
    ProgramCall crash = call({"--fault", "crash", "--size", "4x4", "--quiet"});
    EXPECT_EQ(runProgram(crash).status, -SIGSEGV) << "a debugger wants to see it";
    crash.addressSpace = rlim_t(64) << 30;
    const ProgramResult result = runProgram(crash);
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    EXPECT_NE(result.err.find("not enough memory below the limit of ulimit -v, 65536 MB"), std::string::npos)
        << result.err;
    EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(Cli, APictureThatDoesNotFitIntoMemoryIsRefusedBeforeTheWorkBegins) {
    ProgramCall large = call({"--seconds", "1", "--size", "16384x16384", "--quiet"});
    large.addressSpace = rlim_t(16) << 30;
    const ProgramResult result = runProgram(large);
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.errorLines(), 1) << result.err;
    EXPECT_NE(result.err.find("use a smaller --size"), std::string::npos) << result.err;
    EXPECT_EQ(filesLeft(), 0u) << "the chapter began";
}
#endif

TEST_F(Cli, KilledAtAnyMomentThePictureIsWholeOrAbsent) {
    for (int run = 0; run < 12; ++run) {
        ProgramCall killed = call({"--size", "700x700", "--quiet", "--output", "a.png"});
        killed.signal = SIGKILL;
        killed.signalWhen = [this] { return filesLeft() > 0; };  // as soon as anything of it is there
        runProgram(killed);
        if (std::filesystem::exists(folder / "a.png")) {
            EXPECT_EQ(readImage(folder / "a.png").width, 700);
        }
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            if (entry.path().filename() != "triangle.gltf") std::filesystem::remove(entry.path());
    }
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
    using namespace penumbra;
    if (argc > 1 && std::strcmp(argv[1], "--as-chapter") == 0) {
        const ChapterInfo info{.name = "99_tiny",
                               .idea = "a chapter whose answer is known",
                               .views = {{"color", "grey"}, {"visibility", "a step", true}},
                               .needsGl = false};
        return runChapter<TinyChapter>(info, argc - 1, argv + 1);
    }
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
