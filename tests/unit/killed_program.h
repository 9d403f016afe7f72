// Killing a program at one moment after the other of its work with files: nothing is left to chance.
#pragma once

#include <sys/ptrace.h>
#include <sys/syscall.h>

#include "tests/unit/run_program.h"

namespace penumbra {

/// Does this system call change what is on disk?
inline bool changesFiles(const __ptrace_syscall_info& info) {
    switch (info.entry.nr) {
        case SYS_openat:
            return (info.entry.args[2] & (O_CREAT | O_TRUNC)) != 0;
        case SYS_write:
        case SYS_rename:
        case SYS_unlink:
        case SYS_ftruncate:
        case SYS_fchmod:
            return true;
        default:
            return false;
    }
}

/// Runs the program and kills it (SIGKILL) at the `moment`-th entry to or return from a system call that
/// changes files, counted from 0, of its first thread. Returns how many of these moments there were; more
/// than `moment`: it was killed.
inline int killAtMoment(const ProgramCall& call, int moment) {
    const TemporaryFolder printed;
    const pid_t process = ::fork();
    if (process == 0) {
        ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
        becomeProgram(call, printed / "out", printed / "err");
    }
    int status = 0;
    int moments = 0;
    bool ofFiles = false;
    while (::waitpid(process, &status, 0) == process && WIFSTOPPED(status)) {
        long passedOn = 0;
        if (WSTOPSIG(status) == (SIGTRAP | 0x80)) {
            __ptrace_syscall_info info{};
            ::ptrace(PTRACE_GET_SYSCALL_INFO, process, reinterpret_cast<void*>(sizeof info), &info);
            if (info.op == PTRACE_SYSCALL_INFO_ENTRY) ofFiles = changesFiles(info);
            if (ofFiles && moments++ == moment) ::kill(process, SIGKILL);
        } else if (WSTOPSIG(status) == SIGTRAP) {  // it has become the program
            ::ptrace(PTRACE_SETOPTIONS, process, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
        } else {
            passedOn = WSTOPSIG(status);
        }
        ::ptrace(PTRACE_SYSCALL, process, nullptr, passedOn);
    }
    return moments;
}

}  // namespace penumbra
