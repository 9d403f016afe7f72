#include "common/app/window_loop.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include "common/app/imgui_layer.h"
#include "common/app/orbit_camera.h"
#include "common/app/parameter_step.h"
#include "common/app/window_input.h"
#include "common/app/window_panel.h"
#include "common/app/window_picture.h"
#include "common/error.h"
#include "common/image/image_file.h"
#include "common/image/resample.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double idleSeconds = 0.25;   // how often shaders are looked at while nothing happens
constexpr double turnPerWindow = 3.0;  // radians for a drag across the height of the window
constexpr double turnPerKey = 0.05;    // radians
constexpr double zoomPerNotch = 0.9;   // distance, per notch of the wheel or key press
constexpr double dragSeconds =
    0.06;  // a CPU chapter gets so coarse while dragging that a frame takes no longer
constexpr int coarsest = 16;
constexpr std::size_t framesRemembered = 61;

/// Parameter "light" counts to what its declaration allows; this scene may have fewer.
std::vector<Parameter> parametersOf(const ChapterSession& session, const Parameters& parameters) {
    std::vector<Parameter> limited = parameters.all();
    for (Parameter& parameter : limited)
        if (parameter.name == "light" && std::holds_alternative<int*>(parameter.value))
            parameter.high = std::min(parameter.high, double(session.scene().lights.size()) - 1.0);
    return limited;
}

fs::path unusedFile(const fs::path& folder, const std::string& stem) {
    for (int number = 1;; ++number) {
        const fs::path file = folder / fmt::format("{}-{:03}.png", stem, number);
        if (!fs::exists(file)) return file;
    }
}

class WindowLoop {
 public:
    WindowLoop(const WindowRun& run, const Context& context)
        : session_(run.session),
          screenshotFolder_(run.screenshotFolder),
          window_(context.window()),
          keys_(window_),
          imgui_(context),
          picture_(run.session, context),
          orbit_(run.session.camera(), run.session.scene().bounds) {
        state_.parameters = parametersOf(session_, session_.parameters());
        state_.view = session_.view(session_.options().view).name;
        glfwSwapInterval(1);
    }

    int run() {
        renderPicture();  // the first frame must work
        while (!glfwWindowShouldClose(window_)) {
            if (isVisible() && (needsPicture() || state_.redrawAlways)) {
                glfwPollEvents();
            } else {
                glfwWaitEventsTimeout(idleSeconds);
            }
            frame();
        }
        return exitFine;
    }

 private:
    bool isVisible() const { return framebufferSize(window_) != glm::ivec2(0); }  // else minimised
    bool needsPicture() const {
        return changed_ || divisor_ > 1 || isUnfinished() || framebufferSize(window_) != drawnSize_;
    }
    bool isUnfinished() const {
        return frameError_.empty() && std::ranges::any_of(state_.work, [](const auto& counter) {
                   return counter.first.ends_with("_left") && counter.second > 0;
               });
    }

    void frame() {
        imgui_.begin();
        for (const KeyPress& press : keys_.take())
            if (!ImGui::GetIO().WantTextInput) key(press);
        mouse();
        reloadShaders();
        state_.error = errors();
        changed_ |= drawPanel(session_, state_);
        if (isVisible()) {
            if (needsPicture() || state_.redrawAlways) tryPicture();
            picture_.present(framebufferSize(window_));
        }
        imgui_.draw();
        glfwSwapBuffers(window_);
    }

    void tryPicture() {
        try {
            renderPicture();
            frameError_.clear();
        } catch (const Error& error) {
            frameError_ = error.what();
        }
    }

    /// CPU chapters: coarse at first, then finer with every frame in which nothing changes.
    void renderPicture() {
        drawnSize_ = framebufferSize(window_);
        divisor_ = session_.context() ? 1 : (changed_ ? coarseDivisor_ : std::max(divisor_ / 2, 1));
        changed_ = false;
        const Clock::time_point start = Clock::now();
        picture_.render(state_.view, orbit_.camera(), drawnSize_, divisor_);
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (seconds > dragSeconds && divisor_ >= coarseDivisor_)
            coarseDivisor_ = std::min(2 * coarseDivisor_, coarsest);
        if (seconds < 0.2 * dragSeconds && divisor_ == coarseDivisor_)
            coarseDivisor_ = std::max(coarseDivisor_ / 2, 1);
        state_.work = session_.work();
        state_.frameMs.push_back(1e3 * seconds);
        if (state_.frameMs.size() > framesRemembered) state_.frameMs.pop_front();
    }

    void reloadShaders() {
        const Clock::time_point now = Clock::now();
        if (now - lastLook_ < std::chrono::duration<double>(idleSeconds)) return;
        lastLook_ = now;
        for (Program* program : session_.chapter().programs()) {
            if (!program || !program->sourcesChanged()) continue;
            std::string& error = shaderErrors_[program];
            error = program->reload();  // if it fails, the last good program goes on drawing
            fmt::print(stderr, "{}\n", error.empty() ? "shaders loaded again" : error);
            changed_ = true;
        }
    }

    std::string errors() const {
        std::string all;
        for (const auto& [program, error] : shaderErrors_) all += error.empty() ? "" : error + "\n";
        return all + frameError_;
    }

    void mouse() {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantCaptureMouse) return;
        const double height = std::max(io.DisplaySize.y, 1.0f);
        const double dx = io.MouseDelta.x / height;
        const double dy = io.MouseDelta.y / height;
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && (dx != 0.0 || dy != 0.0)) {
            orbit_.orbit(turnPerWindow * dx, turnPerWindow * dy);
            changed_ = true;
        }
        if (ImGui::IsMouseDown(ImGuiMouseButton_Right) && (dx != 0.0 || dy != 0.0)) {
            orbit_.pan(dx, -dy);
            changed_ = true;
        }
        if (io.MouseWheel != 0.0f) {
            orbit_.zoom(std::pow(zoomPerNotch, io.MouseWheel));
            changed_ = true;
        }
    }

    void key(const KeyPress& press) {
        switch (press.key) {
            case GLFW_KEY_ESCAPE:
                glfwSetWindowShouldClose(window_, GLFW_TRUE);
                break;
            case GLFW_KEY_F1:
                state_.showHelp = !state_.showHelp;
                break;
            case GLFW_KEY_H:
                state_.showPanel = !state_.showPanel;
                break;
            case GLFW_KEY_F2:
            case GLFW_KEY_P:
                screenshot();
                break;
            case GLFW_KEY_TAB:
                choose(press.shift ? -1 : 1);
                break;
            case GLFW_KEY_V:
                nextView(press.shift ? -1 : 1);
                break;
            case GLFW_KEY_COMMA:
                step(-1);
                break;
            case GLFW_KEY_PERIOD:
                step(1);
                break;
            default:
                moveCamera(press.key);
        }
    }

    void moveCamera(int key) {
        switch (key) {
            case GLFW_KEY_LEFT:
                orbit_.orbit(-turnPerKey, 0.0);
                break;
            case GLFW_KEY_RIGHT:
                orbit_.orbit(turnPerKey, 0.0);
                break;
            case GLFW_KEY_UP:
                orbit_.orbit(0.0, turnPerKey);
                break;
            case GLFW_KEY_DOWN:
                orbit_.orbit(0.0, -turnPerKey);
                break;
            case GLFW_KEY_EQUAL:
            case GLFW_KEY_KP_ADD:
                orbit_.zoom(zoomPerNotch);
                break;
            case GLFW_KEY_MINUS:
            case GLFW_KEY_KP_SUBTRACT:
                orbit_.zoom(1.0 / zoomPerNotch);
                break;
            case GLFW_KEY_HOME:
                orbit_.reset();
                break;
            default:
                return;
        }
        changed_ = true;
    }

    void choose(int direction) {
        const std::size_t count = state_.parameters.size();
        if (count > 0) state_.chosen = (state_.chosen + count + std::size_t(direction)) % count;
    }

    void step(int direction) {
        if (state_.parameters.empty()) return;
        stepParameter(state_.parameters[state_.chosen], direction);
        changed_ = true;
    }

    void nextView(int direction) {
        const auto& views = session_.info().views;
        const auto now = std::find_if(views.begin(), views.end(),
                                      [&](const ViewInfo& v) { return v.name == state_.view; });
        const auto count = std::ptrdiff_t(views.size());
        state_.view = views[std::size_t((now - views.begin() + direction + count) % count)].name;
        changed_ = true;
    }

    /// Not what is on the screen but what headless mode would write, of this view, camera and size.
    void screenshot() {
        try {
            const int antialias = session_.options().antialias;
            const FrameRequest request{
                .view = state_.view, .camera = orbit_.camera(), .size = framebufferSize(window_) * antialias};
            const FloatImage picture = boxFilter(session_.picture(request), antialias);
            const fs::path file =
                unusedFile(screenshotFolder_,
                           fmt::format("{}-{}-{}", session_.info().name, session_.scene().name, state_.view));
            writeImage(file, session_.display(picture, session_.view(state_.view)));
            state_.note = "wrote " + file.string();
            fmt::print("{}\n", state_.note);
            std::fflush(stdout);
        } catch (const Error& error) {
            state_.note = error.what();
        }
    }

    ChapterSession& session_;
    fs::path screenshotFolder_;
    GLFWwindow* window_;
    KeyQueue keys_;
    ImGuiLayer imgui_;
    WindowPicture picture_;
    OrbitCamera orbit_;
    WindowState state_;
    std::map<Program*, std::string> shaderErrors_;
    std::string frameError_;
    bool changed_ = true;
    int divisor_ = 1;        ///< of the picture on screen
    int coarseDivisor_ = 8;  ///< to start with when something changes
    glm::ivec2 drawnSize_{0};
    Clock::time_point lastLook_{};
};

}  // namespace

int runWindow(const WindowRun& run) {
    const Context& context = run.session.context() ? *run.session.context() : *run.context;
    return WindowLoop(run, context).run();
}

}  // namespace penumbra
