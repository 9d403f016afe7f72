// The two clocks of the benchmarks, in milliseconds: differences count.
#pragma once

#include <chrono>
#include <ctime>

namespace penumbra {

/// Of all threads of the process together.
inline double cpuTime() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

inline double wallTime() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace penumbra
