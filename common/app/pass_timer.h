// How long each pass of a frame takes, for chapters that name their passes. Off unless --pass-times is given:
// to time a pass alone the GPU must finish it, which costs the overlap that a plain frame time is entitled
// to.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace penumbra {

/// Milliseconds of each pass, one entry for each frame in which it ran.
using PassTimes = std::map<std::string, std::vector<double>>;

class PassTimer {
 public:
    /// Waits for all OpenGL commands issued (when there is a context), then gives the time in milliseconds.
    explicit PassTimer(bool hasGl) : hasGl_(hasGl) {}
    double finishedAt() const;
    void add(const std::string& pass, double milliseconds) { times_[pass].push_back(milliseconds); }
    const PassTimes& times() const { return times_; }
    void clear() { times_.clear(); }

 private:
    bool hasGl_;
    PassTimes times_;
};

/// Times the block it lives in: `PassScope scope(frame.passTimer, "depth");`. Does nothing when `timer` is
/// null.
class PassScope {
 public:
    PassScope(PassTimer* timer, const char* pass)
        : timer_(timer), pass_(pass), start_(timer ? timer->finishedAt() : 0.0) {}
    ~PassScope() {
        if (timer_) timer_->add(pass_, timer_->finishedAt() - start_);
    }
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

 private:
    PassTimer* timer_;
    const char* pass_;
    double start_;
};

}  // namespace penumbra
