// Running a program as a user does: what it printed, and how it ended.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/temporary_folder.h"

namespace penumbra {

struct ProgramResult {
    int status = -1;  ///< exit status, or -signal
    std::string out;
    std::string err;
    double megabytes = 0.0;  ///< most that it held in memory
    long errorLines() const { return std::count(err.begin(), err.end(), '\n'); }
};

struct ProgramCall {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::filesystem::path folder;               ///< where it runs
    std::filesystem::path standardOutput = {};  ///< empty: caught
    int signal = 0;                             ///< sent once `signalWhen` holds
    std::function<bool()> signalWhen = {};
    rlim_t largestFile = RLIM_INFINITY;   ///< bytes, as ulimit -f
    rlim_t addressSpace = RLIM_INFINITY;  ///< bytes, as ulimit -v
};

/// Replaces this (forked) process by the program, without a display.
[[noreturn]] inline void becomeProgram(const ProgramCall& call, const std::filesystem::path& out,
                                       const std::filesystem::path& err) {
    std::vector<char*> arguments{const_cast<char*>(call.program.c_str())};
    for (const std::string& argument : call.arguments)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    const rlimit fileSize{call.largestFile, call.largestFile};
    ::setrlimit(RLIMIT_FSIZE, &fileSize);
    const rlimit noCore{0, 0};
    ::setrlimit(RLIMIT_CORE, &noCore);
    const rlimit addressSpace{call.addressSpace, call.addressSpace};
    ::setrlimit(RLIMIT_AS, &addressSpace);
    if (::chdir(call.folder.c_str()) == 0) ::execv(call.program.c_str(), arguments.data());
    ::_exit(127);
}

inline ProgramResult runProgram(const ProgramCall& call) {
    const TemporaryFolder printed;
    const std::filesystem::path out = call.standardOutput.empty() ? printed / "out" : call.standardOutput;
    const pid_t process = ::fork();
    if (process == 0) becomeProgram(call, out, printed / "err");
    if (call.signal != 0) {
        while (!call.signalWhen()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ::kill(process, call.signal);
    }
    int status = 0;
    rusage used{};
    ::wait4(process, &status, 0, &used);
    ProgramResult result;
    result.megabytes = double(used.ru_maxrss) / 1024.0;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    result.out = bytesOf(printed / "out");
    result.err = bytesOf(printed / "err");
    return result;
}

/// The folder of the running test, which is that of all programs.
inline std::filesystem::path programFolder() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace penumbra
