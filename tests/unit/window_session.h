// A virtual screen, and a chapter's window on it that is used by key presses.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "common/image/image.h"
#include "common/image/srgb.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {

/// Waits until `condition` holds; false after a time in which any machine should have managed.
inline bool waitUntil(const std::function<bool()>& condition) {
    for (int i = 0; i < 1500; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

/// Xvfb on a free display of its own. What it shows can be read.
class VirtualScreen {
 public:
    VirtualScreen() {
        int ends[2];
        if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
        process_ = ::fork();
        if (process_ == 0) {
            ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
            const std::string number = std::to_string(ends[1]);
            ::execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1400x900x24", "-nolisten",
                     "tcp", "-noreset", "-fbdir", shown_.path().c_str(), nullptr);
            ::_exit(127);
        }
        ::close(ends[1]);
        char text[16] = {};
        if (::read(ends[0], text, sizeof(text) - 1) > 0) display_ = ":" + std::to_string(std::atoi(text));
        ::close(ends[0]);
    }
    VirtualScreen(const VirtualScreen&) = delete;
    VirtualScreen& operator=(const VirtualScreen&) = delete;
    ~VirtualScreen() {
        ::kill(process_, SIGTERM);
        ::waitpid(process_, nullptr, 0);
    }
    /// ":7", or "" where Xvfb, xdotool or xrdb is not installed.
    std::string display() const {
        return std::system("command -v xdotool xrdb > /dev/null") == 0 ? display_ : std::string();
    }
    /// What is seen at (x, y) from the upper left, `size` pixels: linear red, green and blue. The screen lies
    /// in a file of the X window dump format (XWDFile.h): numbers of 4 bytes, the largest first, then colours
    /// that nobody uses, then pixels as a small-endian machine holds 0xRRGGBB.
    FloatImage shows(int x, int y, const glm::ivec2& size) const {
        const std::string file = bytesOf(shown_ / "Xvfb_screen0");
        const auto byte = [&](std::size_t at) { return std::size_t(std::uint8_t(file.at(at))); };
        const auto number = [&](std::size_t i) {
            return byte(4 * i) << 24 | byte(4 * i + 1) << 16 | byte(4 * i + 2) << 8 | byte(4 * i + 3);
        };
        const std::size_t headerSize = number(0), bytesPerLine = number(12), colours = number(19);
        FloatImage image(size.x, size.y, 3);
        for (int row = 0; row < size.y; ++row)
            for (int column = 0; column < size.x; ++column)
                for (int c = 0; c < 3; ++c)
                    image.at(column, row, c) = decodeSrgb(
                        float(byte(headerSize + 12 * colours + std::size_t(y + row) * bytesPerLine +
                                   4 * std::size_t(x + column) + 2 - std::size_t(c))) /
                        255.0f);
        return image;
    }
    /// Tells programs started from now on how dense the screen is: 96 dots per inch are scale 1.
    bool setDotsPerInch(int dpi) const {
        return std::system(("echo Xft.dpi: " + std::to_string(dpi) + " | xrdb -nocpp -display " + display_ +
                            " -merge -")
                               .c_str()) == 0;
    }

 private:
    TemporaryFolder shown_;
    pid_t process_ = -1;
    std::string display_;
};

/// `program` in a child process with that display, in `folder`; what it prints is caught.
class WindowSession {
 public:
    WindowSession(const std::string& display, const std::filesystem::path& folder,
                  const std::function<int()>& program)
        : display_(display), folder_(folder) {
        process_ = ::fork();
        if (process_ != 0) return;
        ::setenv("DISPLAY", display.c_str(), 1);
        ::dup2(::open((folder / "out.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        ::dup2(::open((folder / "err.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        ::_exit(::chdir(folder.c_str()) == 0 ? program() : 127);
    }
    WindowSession(const WindowSession&) = delete;
    WindowSession& operator=(const WindowSession&) = delete;
    ~WindowSession() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }

    /// Waits for the window and gives it the keyboard. False if it never comes.
    bool focus(const std::string& title) {
        return waitUntil([&] {
                   return xdotool(fmt::format("search --onlyvisible --name '{}' windowfocus", title)) ||
                          exited();
               }) &&
               !exited();
    }
    bool xdotool(const std::string& arguments) const {
        return std::system(
                   fmt::format("DISPLAY={} xdotool {} > /dev/null 2>&1", display_, arguments).c_str()) == 0;
    }
    /// Presses keys, one after the other, named as X names them.
    void press(const std::string& keys) const { xdotool("key " + keys); }
    /// Waits for a file, relative to the folder.
    bool hasWritten(const std::string& file) {
        return waitUntil([&] { return std::filesystem::exists(folder_ / file) || exited(); }) && !exited();
    }
    std::string errors() const { return bytesOf(folder_ / "err.txt"); }
    /// Waits for the end; exit status, or -signal.
    int status() {
        if (!waitUntil([&] { return exited(); })) return -1000;
        return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
    }

 private:
    bool exited() {
        if (process_ > 0 && ::waitpid(process_, &status_, WNOHANG) == process_) process_ = 0;
        return process_ == 0;
    }

    std::string display_;
    std::filesystem::path folder_;
    pid_t process_ = -1;
    int status_ = 0;
};

}  // namespace penumbra
