#include "common/truth/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <mutex>

namespace penumbra {

void parallelRows(int rows, const std::function<void(int row)>& body, const ProgressCallback& progress) {
    std::mutex mutex;
    int finished = 0;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, rows), [&](const auto& range) {
        for (int row = range.begin(); row != range.end(); ++row) {
            body(row);
            const std::lock_guard lock(mutex);
            ++finished;
            if (progress) progress(double(finished) / rows);
        }
    });
}

}  // namespace penumbra
