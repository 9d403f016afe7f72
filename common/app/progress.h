// A progress bar for work of more than a second, on standard error.
#pragma once

#include <chrono>
#include <string>

#include "common/truth/truth_image.h"

namespace penumbra {

/// On a terminal a bar that is redrawn and wiped away at the end; else (a log file) one plain line for every
/// tenth. Says nothing during the first second, nor when quiet.
class Progress {
 public:
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Begins a new piece of work: "exact answer".
    void start(const std::string& label);
    /// `fraction` done, in [0,1].
    void update(double fraction);
    /// Wipes the bar away; called by `start` and at the end.
    void finish();
    /// `update` as a function, for the duration of this object.
    ProgressCallback callback();

 private:
    bool quiet_;
    bool terminal_;
    std::string label_ = "rendering";
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point drawnAt_;
    int tenthsShown_ = 0;
    bool drawn_ = false;
};

}  // namespace penumbra
