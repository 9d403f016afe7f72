#include "common/app/interrupt.h"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <exception>

#include "common/error.h"
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

/// What `endFailed` says: made beforehand, since a signal handler cannot allocate.
std::array<char, 512> crashText{};

extern "C" void endFailed(int) {
    removeUnfinishedFile();
    [[maybe_unused]] const ssize_t ignored =
        ::write(STDERR_FILENO, crashText.data(), std::strlen(crashText.data()));
    ::_exit(exitFailed);
}

}  // namespace

void endCleanlyOnInterrupt() {
    struct sigaction action {};
    action.sa_handler = endNow;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    // A file larger than ulimit -f allows: the write fails with a reason instead of killing us.
    action.sa_handler = SIG_IGN;
    ::sigaction(SIGXFSZ, &action, nullptr);
}

void sayOnCrash(const std::string& line) {
    const std::string text = line.substr(0, crashText.size() - 2) + "\n";
    std::memcpy(crashText.data(), text.c_str(), text.size() + 1);
    // Where the stack is what could not grow, the handler needs another.
    static std::array<char, 65536> stack;
    const stack_t other{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
    ::sigaltstack(&other, nullptr);
    struct sigaction action {};
    action.sa_handler = endFailed;
    action.sa_flags = SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) ::sigaction(signal, &action, nullptr);
    std::set_terminate([] { endFailed(SIGABRT); });
}

}  // namespace penumbra
