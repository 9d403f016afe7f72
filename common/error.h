// The one exception type of the project, and the exit statuses of the command-line contract.
#pragma once

#include <stdexcept>
#include <string>

namespace penumbra {

/// 0 fine, 1 the work failed, 2 the command line is wrong.
enum ExitStatus { exitFine = 0, exitFailed = 1, exitUsage = 2 };

/// Stops the program with one line that says what went wrong, where, and what to do about it.
/// Thrown anywhere; caught once, in `runChapter` (or a tool's main), which prints `what()` and exits.
class Error : public std::runtime_error {
 public:
    explicit Error(const std::string& whatWhereAndWhatToDo, ExitStatus status = exitFailed)
        : std::runtime_error(whatWhereAndWhatToDo), status_(status) {}
    ExitStatus status() const { return status_; }

 private:
    ExitStatus status_;
};

/// A wrong command line: exit status 2.
class UsageError : public Error {
 public:
    explicit UsageError(const std::string& whatWhereAndWhatToDo) : Error(whatWhereAndWhatToDo, exitUsage) {}
};

}  // namespace penumbra
