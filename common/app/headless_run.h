// A chapter without a window: time it, compare it, write what was asked for.
#pragma once

#include <chrono>

#include "common/app/chapter_session.h"
#include "common/app/progress.h"

namespace penumbra {

/// `start`: when the program started, for setup_ms. Throws Error.
void runHeadless(ChapterSession& session, Progress& progress, std::chrono::steady_clock::time_point start);

/// Throws Error at once if a file that will be written at the end cannot be. Fills in the default output.
void prepareOutputs(const ChapterInfo& info, Options& options);

}  // namespace penumbra
