// Progress of frames that take long.
#pragma once

#include <chrono>

#include "common/app/chapter.h"

namespace penumbra {

/// `frame.progress`, silent until a second from now: most frames in a window are over by then, and a bar for
/// each of them would flicker. The frame must outlive it.
inline ProgressCallback slowFrameProgress(const Frame& frame) {
    const auto start = std::chrono::steady_clock::now();
    return [&frame, start](double fraction) {
        const bool slow = std::chrono::steady_clock::now() - start > std::chrono::seconds(1);
        if (slow && frame.progress) frame.progress(fraction);
    };
}

}  // namespace penumbra
