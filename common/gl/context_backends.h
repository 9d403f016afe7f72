// What each back end supplies to createContext; private to common/gl.
#pragma once

#include <memory>
#include <string>

#include "common/gl/context.h"
#include "common/gl/gl.h"

namespace penumbra {

/// A context that is current, and the way to its functions.
struct BackendContext {
    std::unique_ptr<Context> context;
    GetGlProcAddress getProcAddress = nullptr;
};

// Each throws Error with a short reason when this machine cannot.
BackendContext createGlfwContext(const ContextRequest& request);
BackendContext createOsmesaContext(const ContextRequest& request);
BackendContext createEglContext(const ContextRequest& request);

}  // namespace penumbra
