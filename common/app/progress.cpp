#include "common/app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace penumbra {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr double patience = 1.0;        // seconds before anything is shown
constexpr double redrawInterval = 0.1;  // seconds
constexpr int barWidth = 30;

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {
    start(label_);
}

Progress::~Progress() {
    finish();
}

void Progress::start(const std::string& label) {
    finish();
    label_ = label;
    start_ = drawnAt_ = std::chrono::steady_clock::now();
    tenthsShown_ = 0;
}

void Progress::update(double fraction) {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = Seconds(now - start_).count();
    if (quiet_ || elapsed < patience) return;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const int percent = int(100.0 * fraction);
    if (!terminal_) {
        if (percent / 10 > tenthsShown_) fmt::print(stderr, "{}: {} %, {:.0f} s\n", label_, percent, elapsed);
        tenthsShown_ = std::max(tenthsShown_, percent / 10);
        return;
    }
    if (drawn_ && Seconds(now - drawnAt_).count() < redrawInterval) return;
    const int filled = int(barWidth * fraction);
    const double left = fraction > 0.0 ? elapsed * (1.0 - fraction) / fraction : 0.0;
    fmt::print(stderr, "\r\x1b[K{} [{:#<{}}{:.<{}}] {} %, about {:.0f} s left", label_, "", filled, "",
               barWidth - filled, percent, left);
    std::fflush(stderr);
    drawnAt_ = now;
    drawn_ = true;
}

void Progress::finish() {
    if (drawn_) fmt::print(stderr, "\r\x1b[K");
    drawn_ = false;
}

ProgressCallback Progress::callback() {
    return [this](double fraction) { update(fraction); };
}

}  // namespace penumbra
