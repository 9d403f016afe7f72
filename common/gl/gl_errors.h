// KHR_debug messages of type error, kept until the next checkGlErrors; private to common/gl.
#pragma once

#include "common/gl/gl.h"

namespace penumbra {

/// Forgets what was pending and, when the context has KHR_debug, starts to listen.
void listenForGlErrors();

}  // namespace penumbra
