#include "common/app/interrupt.h"

#include <unistd.h>
#include <csignal>
#include <cstring>

#include "common/image/file_write.h"

namespace penumbra {
namespace {

constexpr int statusOfSignal = 128;  // the shell's convention: 130 is SIGINT

/// Only async-signal-safe calls: unlink, write, _exit.
extern "C" void endNow(int signal) {
    removeUnfinishedFile();
    // On a terminal the cursor may stand behind "^C" or in a progress bar: begin a line of our own.
    const char* text = ::isatty(STDERR_FILENO) ? "\r\x1b[Kinterrupted; no unfinished file is left behind\n"
                                               : "interrupted; no unfinished file is left behind\n";
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text, std::strlen(text));
    ::_exit(statusOfSignal + signal);
}

}  // namespace

void endCleanlyOnInterrupt() {
    struct sigaction action {};
    action.sa_handler = endNow;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
}

}  // namespace penumbra
