// Rows of a picture on all cores.
#pragma once

#include <functional>

namespace penumbra {

/// fraction in [0,1] done; called from time to time, from one thread at a time.
using ProgressCallback = std::function<void(double fraction)>;

/// Calls `body(row)` once for each row in [0, rows), in any order, on all cores. The picture is the same for
/// any number of threads as long as a row depends on nothing but its number. What `body` throws stops the
/// loop and is thrown here.
void parallelRows(int rows, const std::function<void(int row)>& body, const ProgressCallback& progress = {});

}  // namespace penumbra
