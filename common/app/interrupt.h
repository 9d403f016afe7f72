// Ctrl-C, and other ways in which a program ends from one moment to the next.
#pragma once

#include <string>

namespace penumbra {

/// From now on SIGINT and SIGTERM end the program at once with one line and status 130 or 143, and leave no
/// half-written file behind. A file larger than `ulimit -f` is an Error like a full disk, and no signal.
void endCleanlyOnInterrupt();

/// From now on a crash (an invalid address, abort, an exception that nobody catches) prints this line and
/// ends the program with status 1. For when a reason is known that is not ours; else a crash is better left
/// to the debugger.
void sayOnCrash(const std::string& line);

}  // namespace penumbra
