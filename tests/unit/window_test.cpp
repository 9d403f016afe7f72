// The window as a reader uses it: keys are pressed on a virtual screen, and what it saves must be what
// headless mode writes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/app/chapter.h"
#include "common/app/window_input.h"
#include "common/error.h"
#include "common/gl/context.h"
#include "common/gl/fullscreen.h"
#include "common/gl/gl.h"
#include "common/image/compare.h"
#include "common/image/image_file.h"
#include "tests/unit/gltf_builder.h"
#include "tests/unit/window_session.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

const char* const patternShader =
    "in vec2 vUv;\n"
    "uniform float uStripes;\n"
    "uniform float uCount;\n"
    "uniform vec3 uEye;\n"
    "out vec4 color;\n"
    "void main() {\n"
    "    color = vec4(0.5 * vUv, 0.1 * uCount, 1.0) + uStripes * vec4(fract(8.0 * vUv.x));\n"
    "    color.rgb += 0.2 * uEye;\n"
    "}\n";

/// Shows its parameters and where the camera is; on the GPU, or pixel by pixel on the CPU.
class PatternChapter : public Chapter {
 public:
    void declare(Parameters& parameters) override {
        parameters.add("stripes", stripes_, "draw stripes");
        parameters.add("count", count_, 1, 8, "", "how blue");
        parameters.add("spare", spare_, 1, 8, "",
                       "changes nothing: three are needed to tell Tab from Shift+Tab");
    }
    void load(const Scene&, const Context* context) override {
        if (!context) return;
        program_ = std::make_unique<Program>("common/fullscreen.vert", "pattern.frag");
        triangle_ = std::make_unique<FullscreenTriangle>();
    }
    void render(const Frame& frame) override {
        frame.work["pictures"] += 1;
        if (!program_) return renderOnCpu(frame);
        glDisable(GL_DEPTH_TEST);
        program_->set("uStripes", stripes_ ? 0.3f : 0.0f);
        program_->set("uCount", float(count_));
        program_->set("uEye", glm::vec3(frame.camera.position));
        program_->prepareToDraw();
        triangle_->draw();
    }
    TruthImage truth(const TruthRequest&) override { throw UsageError("no truth"); }
    std::vector<Program*> programs() override { return {program_.get()}; }

 private:
    void renderOnCpu(const Frame& frame) const {
        *frame.cpuPicture = FloatImage(frame.size.x, frame.size.y, 3, 0.1f * float(count_));
        for (int x = 0; x < frame.size.x; ++x)
            for (int y = 0; y < frame.size.y; ++y)
                frame.cpuPicture->at(x, y, y > x ? 0 : 1) = float(x) / float(frame.size.x);
    }

    bool stripes_ = false;
    int count_ = 3, spare_ = 1;
    std::unique_ptr<Program> program_;
    std::unique_ptr<FullscreenTriangle> triangle_;
};

int runPattern(std::vector<std::string> arguments, bool needsGl = true) {
    const ChapterInfo info{.name = "98_pattern",
                           .idea = "a test pattern",
                           .views = {{.name = "color", .help = "the pattern", .exposureScale = 0.0}},
                           .needsGl = needsGl};
    std::string name = info.name;
    std::string sceneFlag = "--scene";
    std::string scene = "./square.glb";
    std::vector<char*> argv{name.data(), sceneFlag.data(), scene.data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    return runChapter<PatternChapter>(info, int(argv.size()), argv.data());
}

class WindowTest : public testing::Test {
 protected:
    void SetUp() override {
        ASSERT_FALSE(screen_.display().empty())
            << "install xvfb, xdotool and x11-xserver-utils (./test does)";
        fs::create_directories(folder_ / "shaders");
        fs::copy(PENUMBRA_SOURCE_DIR "/shaders/common", folder_ / "shaders/common",
                 fs::copy_options::recursive);
        writeShader(patternShader);
        ::setenv("PENUMBRA_SHADERS", (folder_ / "shaders").c_str(), 1);
        const FileBytes scene = squareScene().glb();
        std::ofstream(folder_ / "square.glb", std::ios::binary)
            .write(reinterpret_cast<const char*>(scene.data()), std::streamsize(scene.size()));
    }
    void TearDown() override { ::unsetenv("PENUMBRA_SHADERS"); }

    void writeShader(const std::string& text) {
        std::ofstream(folder_ / "shaders/pattern.frag") << text;
        fs::last_write_time(folder_ / "shaders/pattern.frag",
                            fs::file_time_type::clock::now() + std::chrono::seconds(++writes_));
    }
    std::unique_ptr<WindowSession> open(std::vector<std::string> arguments = {}, bool needsGl = true) {
        arguments.insert(arguments.end(), {"--backend", "window"});
        auto window = std::make_unique<WindowSession>(screen_.display(), folder_.path(),
                                                      [=] { return runPattern(arguments, needsGl); });
        EXPECT_TRUE(window->focus("Penumbra 98_pattern")) << window->errors();
        return window;
    }
    FloatImage headless(std::vector<std::string> arguments, bool needsGl = true,
                        const std::string& size = "1280x800") {
        arguments.insert(arguments.end(), {"--headless", "--quiet", "--size", size, "--output", "truth.png"});
        WindowSession process("", folder_.path(), [=] { return runPattern(arguments, needsGl); });
        EXPECT_EQ(process.status(), 0) << process.errors();
        return readImage(folder_ / "truth.png");
    }
    FloatImage screenshot(WindowSession& window, int number) {
        const std::string file = fmt::format("out/98_pattern-square-color-{:03}.png", number);
        window.press("F2");
        EXPECT_TRUE(window.hasWritten(file)) << window.errors();
        return readImage(folder_ / file);
    }
    static void expectQuit(WindowSession& window) {
        window.press("Escape");
        EXPECT_EQ(window.status(), 0) << window.errors();
    }
    static double difference(const FloatImage& a, const FloatImage& b) { return compareImages(a, b).maxAbs; }

    static constexpr double step = 0.0092;  // of 8 bits in sRGB near white, in linear light
    VirtualScreen screen_;
    TemporaryFolder folder_;
    int writes_ = 0;
};

TEST_F(WindowTest, AScreenshotAfterKeyPressesIsTheHeadlessPictureWithThoseParameters) {
    const auto window = open();
    window->press("period Tab period period");
    const FloatImage picture = screenshot(*window, 1);
    EXPECT_LE(difference(picture, headless({"--stripes", "--count", "5"})), step);
    EXPECT_GT(difference(picture, headless({})), 0.05) << "a change that does not show proves nothing";
    window->press("shift+Tab comma");
    EXPECT_LE(difference(screenshot(*window, 2), headless({"--count", "5"})), step);
    window->press("Tab comma comma comma");
    EXPECT_LE(difference(screenshot(*window, 3), headless({"--count", "2"})), step);
    expectQuit(*window);
}

TEST_F(WindowTest, HeadlessUsesNoDisplayEvenWhereThereIsOne) {
    WindowSession process(screen_.display(), folder_.path(), [] {
        const bool headless = createContext({.headless = true})->backend() != Backend::window;
        return headless && createContext({.headless = false})->backend() == Backend::window ? 0 : 1;
    });
    EXPECT_EQ(process.status(), 0) << process.errors();
}

TEST_F(WindowTest, EsDrawsTheSame) {
    WindowSession process(screen_.display(), folder_.path(), [] {
        const auto context = createContext({.backend = Backend::window, .api = Api::es, .headless = false});
        return context->version().rfind("OpenGL ES", 0) == 0 ? 0 : 1;
    });
    EXPECT_EQ(process.status(), 0) << process.errors();
    const auto window = open({"--api", "es"});
    window->press("period F1 F1");
    EXPECT_LE(difference(screenshot(*window, 1), headless({"--stripes"})), step);
    expectQuit(*window);
}

TEST_F(WindowTest, SizeIsTheSizeOfTheWindow) {
    const auto window = open({"--size", "700x300"});
    const FloatImage picture = screenshot(*window, 1);
    EXPECT_EQ(picture.width, 700);
    EXPECT_EQ(picture.height, 300);
    expectQuit(*window);
}

// A screenshot is drawn anew: that the window itself follows its size can be seen on the screen alone. Drawn
// into the target of the old size, the picture's lower left corner would fill the window.
TEST_F(WindowTest, TheScreenShowsThePictureOfTheWindowsNewSize) {
    const auto window = open({"--size", "160x100"});
    window->press("h");                     // no panel in front of it
    window->xdotool("mousemove 1390 890");  // no pointer either
    for (const glm::ivec2& size : {glm::ivec2(160, 100), glm::ivec2(240, 160), glm::ivec2(120, 200)}) {
        window->xdotool(
            fmt::format("search --onlyvisible --name 'Penumbra 98_pattern' windowsize {} {} windowmove 0 0",
                        size.x, size.y));
        const FloatImage expected = headless({}, true, fmt::format("{}x{}", size.x, size.y));
        double off = 1.0;
        const auto isShown = [&] { return (off = difference(screen_.shows(0, 0, size), expected)) <= step; };
        ASSERT_TRUE(waitUntil(isShown)) << size.x << "x" << size.y << ": off by " << off;
    }
    expectQuit(*window);
}

class WindowSlow : public WindowTest {};

TEST_F(WindowSlow, ManySizesKeysAndShadersLaterItStillDrawsTheSame) {
    const auto window = open();
    for (int i = 0; i < 15; ++i) {
        window->xdotool(fmt::format("search --onlyvisible --name 'Penumbra 98_pattern' windowsize {} {}",
                                    1 + 53 * i % 1200, 1 + 37 * i % 700));
        window->press("Tab period v Right F1 h F1 h Home shift+Tab");
        if (i % 5 == 0) writeShader(patternShader);
    }
    window->xdotool("search --onlyvisible --name 'Penumbra 98_pattern' windowsize --sync 320 200");
    EXPECT_EQ(window->errors().find("error"), std::string::npos) << window->errors();
    const FloatImage picture = screenshot(*window, 1);
    ASSERT_EQ(picture.width, 320);
    ASSERT_EQ(picture.height, 200);
    EXPECT_LE(difference(picture, headless({"--count", "8"}, true, "320x200")), step)
        << "15 times up is 8, the most";
    expectQuit(*window);
}

TEST_F(WindowTest, OnADenseScreenThePanelGrowsAndThePictureFillsTheWindow) {
    ASSERT_TRUE(screen_.setDotsPerInch(192));
    WindowSession scaled(screen_.display(), folder_.path(), [] {
        const auto context = createContext({.backend = Backend::window, .headless = false});
        return interfaceScale(context->window()) == 2.0f ? 0 : 1;
    });
    EXPECT_EQ(scaled.status(), 0) << scaled.errors();
    const auto window =
        open({"--size", "640x400"});  // points: 1280x800 pixels, and the picture has to fill them
    EXPECT_LE(difference(screenshot(*window, 1), headless({})), step);
    expectQuit(*window);
}

TEST_F(WindowTest, ACpuChapterIsDrawnInFull) {
    const auto window = open({}, false);
    window->press("Tab period");
    EXPECT_LE(difference(screenshot(*window, 1), headless({"--count", "4"}, false)), step);
    expectQuit(*window);
}

TEST_F(WindowTest, TheCameraMovesAndComesHome) {
    const auto window = open();
    const FloatImage start = screenshot(*window, 1);
    int taken = 1;
    for (const auto& [key, back] : std::vector<std::pair<std::string, std::string>>{
             {"Right", "Left"}, {"Up", "Down"}, {"plus", "minus"}}) {
        for (const std::string& one : {key, back}) {
            window->press(one);
            EXPECT_GT(difference(screenshot(*window, ++taken), start), step) << one;
            window->press("Home");
            EXPECT_EQ(difference(screenshot(*window, ++taken), start), 0.0) << "Home after " << one;
        }
        window->press(key + " " + back);
        EXPECT_LE(difference(screenshot(*window, ++taken), start), step) << back << " undoes " << key;
        window->press("Home");
    }
    window->xdotool(
        "mousemove 700 600 sleep 0.4 mousedown 1 sleep 0.4 mousemove 900 500 sleep 0.4 mouseup 1");
    EXPECT_GT(difference(screenshot(*window, ++taken), start), step);
    expectQuit(*window);
}

TEST_F(WindowTest, AShaderIsLoadedAgainAndABrokenOneIsNamedAndNotUsed) {
    const auto window = open();
    const FloatImage start = screenshot(*window, 1);
    writeShader("out vec4 color;\nvoid main() {\n    color = vec4(ghost);\n}\n");
    EXPECT_TRUE(waitUntil([&] { return window->errors().find("pattern.frag:3: ") != std::string::npos; }))
        << window->errors();
    EXPECT_EQ(difference(screenshot(*window, 2), start), 0.0) << "the last good program goes on drawing";
    writeShader(
        "uniform float uStripes, uCount;\nuniform vec3 uEye;\nout vec4 color;\n"
        "void main() { color = vec4(0.0, 1e6, 0.0, 1.0); }\n");
    EXPECT_TRUE(waitUntil([&] { return window->errors().find("loaded again") != std::string::npos; }));
    EXPECT_GT(difference(screenshot(*window, 3), start), 0.3);
    expectQuit(*window);
}

TEST_F(WindowTest, AFirstFrameThatFailsEndsTheProgram) {
    writeShader("out vec4 color;\nuniform float uNeverSet;\nvoid main() { color = vec4(uNeverSet); }\n");
    WindowSession window(screen_.display(), folder_.path(), [] {
        return runPattern({"--backend", "window"});
    });
    EXPECT_EQ(window.status(), 1);
    EXPECT_NE(window.errors().find("uStripes"), std::string::npos) << window.errors();
}

}  // namespace
}  // namespace penumbra
