// Ctrl-C.
#pragma once

namespace penumbra {

/// From now on SIGINT and SIGTERM end the program at once with one line and status 130 or 143, and leave no
/// half-written file behind.
void endCleanlyOnInterrupt();

}  // namespace penumbra
