// The window: orbit camera, panel of parameters, hot reload, screenshots. What a chapter draws in it is what
// it draws headless.
#pragma once

#include <filesystem>

#include "common/app/chapter_session.h"

namespace penumbra {

struct WindowRun {
    ChapterSession& session;  ///< made with headless false; for a CPU chapter, see `context`
    /// A window context of one's own for a chapter that draws on the CPU (session.context() is null then);
    /// else unused.
    const Context* context = nullptr;
    std::filesystem::path screenshotFolder = "out";  ///< files CHAPTER-SCENE-VIEW-NNN.png
};

/// Runs until the window is closed; returns the exit status. Throws Error when the first frame cannot be
/// drawn; later errors (a shader edited into nonsense, say) are shown on screen.
int runWindow(const WindowRun& run);

}  // namespace penumbra
