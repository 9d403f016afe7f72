// The panel beside the picture: parameters, views, times and counters, help.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "common/app/chapter_session.h"

namespace penumbra {

/// What the panel shows and changes.
struct WindowState {
    std::vector<Parameter> parameters;  ///< ranges as far as this scene allows
    std::size_t chosen = 0;             ///< the one that , and . change
    std::string view;
    bool showPanel = true;
    bool showHelp = false;
    bool redrawAlways = false;   ///< to watch the frame time
    std::string error;           ///< of the latest frame and of shaders
    std::string note;            ///< about the latest screenshot
    std::deque<double> frameMs;  ///< latest last
    WorkCounters work;           ///< of the picture on screen
};

/// Describes the panel to Dear ImGui. True if parameters or view were changed, so that the picture must be
/// drawn again.
bool drawPanel(const ChapterSession& session, WindowState& state);

}  // namespace penumbra
