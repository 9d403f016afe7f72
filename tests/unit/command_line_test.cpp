#include "common/app/command_line.h"

#include <gtest/gtest.h>

#include <vector>

#include "common/app/flag.h"
#include "common/error.h"

namespace penumbra {
namespace {

constexpr Skip unseen{"unseen", "", "what nobody sees is not drawn"};
constexpr Skip kept{"kept-maps", "", "what has not changed is kept"};

struct Line {
    ChapterInfo info{
        .name = "99_test", .idea = "a test", .views = {{"color", "shaded"}, {"visibility", "S", true}}};
    int samples = 4;
    float bias = 1.0f;
    bool front = false;
    std::string method = "slope";
    Parameters parameters;

    Line() {
        parameters.add("samples", samples, 1, 64, "", "how many");
        parameters.add("bias", bias, -2.0f, 8.0f, "texels", "how much");
        parameters.add("front", front, "which");
        parameters.add("method", method, {"none", "slope"}, "which one");
        for (const Skip* skip : {&unseen, &kept}) parameters.skips().declare(*skip);
    }
    Options parse(std::vector<const char*> arguments) {
        arguments.insert(arguments.begin(), "99_test");
        return *parseCommandLine(info, parameters, int(arguments.size()), arguments.data());
    }
    std::string refusal(const std::vector<const char*>& arguments) {
        try {
            parse(arguments);
            return "";
        } catch (const UsageError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
    }
};

TEST(CommandLine, WithoutFlagsThereAreTheDefaultsOfTheHelp) {
    const Options o = Line().parse({});
    EXPECT_FALSE(o.headless);
    EXPECT_EQ(o.scene, "courtyard");
    EXPECT_EQ(o.size, glm::ivec2(512, 512));
    EXPECT_EQ(o.view, "color");
    EXPECT_EQ(o.runs, 1);
    EXPECT_EQ(o.seed, 1u);
    EXPECT_EQ(o.antialias, 1);
    EXPECT_FALSE(o.exposureEv.has_value());
    EXPECT_TRUE(o.output.empty());
}

TEST(CommandLine, EveryFlagArrives) {
    Line line;
    const Options o = line.parse(
        {"--headless",   "--backend",   "egl",        "--api",   "es",          "--scene", "a/b.glb",
         "--camera",     "3",           "--size",     "640x480", "--view",      "error",   "--compare-truth",
         "--output",     "o/p.EXR",     "--report",   "-",       "--runs",      "7",       "--seed",
         "4294967295",   "--skip-none", "--exposure", "-1.5",    "--antialias", "4",       "--quiet",
         "--pass-times", "--still"});
    EXPECT_TRUE(o.headless && o.compareTruth && o.quiet && o.passTimes && o.still);
    EXPECT_TRUE(line.parameters.skips().allOff());
    EXPECT_EQ(o.backend, Backend::egl);
    EXPECT_EQ(o.api, Api::es);
    EXPECT_EQ(o.scene, "a/b.glb");
    EXPECT_EQ(o.camera, 3);
    EXPECT_EQ(o.size, glm::ivec2(640, 480));
    EXPECT_EQ(o.windowSize, glm::ivec2(640, 480));
    EXPECT_EQ(o.view, "error");
    EXPECT_EQ(o.output, "o/p.EXR");
    EXPECT_EQ(o.report, "-");
    EXPECT_EQ(o.runs, 7);
    EXPECT_EQ(o.seed, 4294967295u);
    EXPECT_EQ(o.exposureEv, -1.5);
    EXPECT_EQ(o.antialias, 4);
    EXPECT_FALSE(line.parse({"--exposure", "auto"}).exposureEv.has_value());
    EXPECT_EQ(line.parse({"--view", "lit"}).view, "color");
}

TEST(CommandLine, EveryParameterIsAFlag) {
    Line line;
    line.parse({"--samples", "64", "--bias", "-1.5", "--front", "--method=none"});
    EXPECT_EQ(line.samples, 64);
    EXPECT_EQ(line.bias, -1.5f);
    EXPECT_TRUE(line.front);
    EXPECT_EQ(line.method, "none");
    line.parse({"--front", "off", "--bias=-2", "--samples", "1", "--samples", "2"});
    EXPECT_FALSE(line.front);
    EXPECT_EQ(line.bias, -2.0f);
    EXPECT_EQ(line.samples, 2) << "the last one counts, so that a script's flags can be overridden";
}

TEST(CommandLine, SkipsAreSwitchedOffByNameOrAllAtOnce) {
    using Names = std::vector<std::string>;
    const auto off = [](const std::vector<const char*>& arguments) {
        Line line;
        line.parse(arguments);
        return line.parameters.skips().off();
    };
    EXPECT_EQ(off({}), Names{});
    EXPECT_EQ(off({"--no-skip", "kept-maps"}), Names{"kept-maps"});
    EXPECT_EQ(off({"--no-skip=kept-maps", "--no-skip", "unseen", "--no-skip", "unseen"}),
              (Names{"unseen", "kept-maps"}));
    EXPECT_EQ(off({"--no-skip", "unseen", "--skip-none"}), (Names{"unseen", "kept-maps"}));
    Line line;
    EXPECT_EQ(line.refusal({"--no-skip", "kept-map"}),
              "--no-skip kept-map: must be one of unseen, kept-maps; did you mean kept-maps?");
    EXPECT_EQ(line.refusal({"--no-skip", ""}), "--no-skip \"\": must be one of unseen, kept-maps");
    EXPECT_EQ(line.refusal({"--no-skip"}), "--no-skip: needs a value; see --help");
    EXPECT_NE(line.refusal({"--no-skip", "unseen", "kept-maps"}), "") << "one name a flag, as all flags have";
}

TEST(CommandLine, FilesAndFiguresImplyHeadless) {
    using Arguments = std::vector<const char*>;
    for (const Arguments& arguments :
         {Arguments{"--output", "a.png"}, Arguments{"--report", "-"}, Arguments{"--compare-truth"},
          Arguments{"--runs", "2"}, Arguments{"--backend", "osmesa"}, Arguments{"--pass-times"},
          Arguments{"--still"}})
        EXPECT_TRUE(Line().parse(arguments).headless) << arguments.front();
    EXPECT_FALSE(Line().parse({"--scene", "room", "--bias", "2"}).headless);
}

TEST(CommandLine, SizesFromOnePixelToTheLargest) {
    EXPECT_EQ(parseSize("1x1"), glm::ivec2(1, 1));
    EXPECT_EQ(parseSize("16384x1"), glm::ivec2(16384, 1));
    EXPECT_EQ(parseSize("16384x16384"), glm::ivec2(16384, 16384));
    for (const char* bad :
         {"0x0", "1x-1", "-1x1", "100000x100000", "16385x1", "1x0", "abc", "", "x", "1x", "x1", "1X1",
          "1x1x1", " 1x1", "1x1 ", "1.5x1", "1e2x1", "99999999999999999999x1", "512"})
        EXPECT_THROW(parseSize(bad), UsageError) << '"' << bad << '"';
}

TEST(CommandLine, EveryMistakeNamesTheFlagTheValueAndWhatIsAllowed) {
    Line line;
    EXPECT_EQ(line.refusal({"--size", "0x0"}),
              "--size 0x0: must be WIDTHxHEIGHT in pixels, from 1x1 to 16384x16384, such as 512x512");
    EXPECT_EQ(line.refusal({"--view", "colour"}),
              "--view colour: must be one of color, visibility, truth, error; did you mean color?");
    EXPECT_EQ(line.refusal({"--bias", "nan"}), "--bias nan: must be a number from -2 to 8 texels");
    EXPECT_EQ(line.refusal({"--bias", "-inf"}), "--bias -inf: must be a number from -2 to 8 texels");
    EXPECT_EQ(line.refusal({"--runs", "0"}), "--runs 0: must be a number from 1 to 10000");
    EXPECT_EQ(line.refusal({"--exposure", "nan"}), "--exposure nan: must be a number from -20 to 20");
    EXPECT_EQ(line.refusal({"--backend", "vulkan"}),
              "--backend vulkan: must be one of auto, window, osmesa, egl");
    EXPECT_EQ(line.refusal({"--samplse", "3"}),
              "--samplse: unknown flag; did you mean --samples? (--help lists them all)");
    EXPECT_EQ(line.refusal({"--samples"}), "--samples: needs a value; see --help");
    EXPECT_EQ(line.refusal({"--quiet=off"}), "--quiet=off: --quiet takes no value");
    EXPECT_EQ(line.refusal({"--view", "truth"}),
              "--view truth: needs --compare-truth, which computes the exact answer");
    for (const std::vector<const char*>& bad :
         std::vector<std::vector<const char*>>{{"contact"},
                                               {"-x"},
                                               {"--"},
                                               {"--output", "a.jpg"},
                                               {"--output", "a"},
                                               {"--output", ""},
                                               {"--scene", ""},
                                               {"--report", ""},
                                               {"--seed", "-1"},
                                               {"--seed", "4294967296"},
                                               {"--camera", "-1"},
                                               {"--antialias", "0"},
                                               {"--antialias", "17"},
                                               {"--antialias", "8", "--size", "4096x4"},
                                               {"--api", "metal"},
                                               {"--front", "maybe"},
                                               {"--headless", "--backend", "window"},
                                               {"--quiet", "yes"},
                                               {"--help=3"},
                                               {"--runs", "1e3"}})
        EXPECT_NE(line.refusal(bad), "") << bad.front();
}

TEST(CommandLine, QuestionsAreAnsweredAndNothingElseIsDone) {
    Line line;
    for (const char* question : {"--help", "-h", "--version", "--list-parameters", "--list-skips"}) {
        const char* arguments[] = {"99_test", question};
        testing::internal::CaptureStdout();
        EXPECT_FALSE(parseCommandLine(line.info, line.parameters, 2, arguments).has_value());
        EXPECT_NE(testing::internal::GetCapturedStdout(), "") << question;
    }
}

TEST(CommandLine, TheHelpExplainsEveryFlagViewAndParameterInHundredColumns) {
    Line line;
    Options options;
    const auto flags = chapterFlags(line.info, line.parameters, options);
    const std::string help = helpText(line.info, flags, line.parameters);
    for (const Flag& flag : flags) {
        EXPECT_NE(help.find("  --" + flag.name), std::string::npos) << flag.name;
        EXPECT_FALSE(flag.help.empty()) << flag.name;
    }
    EXPECT_NE(help.find("Skips (--no-skip NAME)\n  unseen"), std::string::npos);
    EXPECT_NE(help.find("what has not changed is kept"), std::string::npos);
    EXPECT_NE(help.find("visibility"), std::string::npos);
    EXPECT_NE(help.find("[-2 to 8 texels (default 1)]"), std::string::npos);
    EXPECT_NE(help.find("[none, slope (default slope)]"), std::string::npos);
    for (std::size_t begin = 0; begin < help.size();) {
        const std::size_t end = help.find('\n', begin);
        EXPECT_LE(end - begin, 100u) << help.substr(begin, end - begin);
        begin = end + 1;
    }
}

}  // namespace
}  // namespace penumbra
