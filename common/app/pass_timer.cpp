#include "common/app/pass_timer.h"

#include "common/gl/gl.h"

namespace penumbra {

double PassTimer::finishedAt() const {
    if (hasGl_) glFinish();
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
}

}  // namespace penumbra
