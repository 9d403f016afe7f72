// A window, through GLFW.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "common/error.h"
#include "common/gl/context_backends.h"

namespace penumbra {
namespace {

std::string glfwReason(const char* what) {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? std::string(what) + " (" + description + ")" : what;
}

/// glfwInit and glfwTerminate as a value, so that a failure half way leaves nothing behind.
struct GlfwLibrary {
    GlfwLibrary() {
        if (!glfwInit()) throw Error(glfwReason("no display can be reached"));
    }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
    ~GlfwLibrary() { glfwTerminate(); }
};

void setHints(Api api) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    if (api == Api::es) {
        glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
        glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    } else {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);  // macOS gives a core profile only with this
    }
}

class GlfwContext : public Context {
 public:
    explicit GlfwContext(const ContextRequest& request) {
        setHints(request.api);
        window_ = glfwCreateWindow(request.windowSize.x, request.windowSize.y, request.title.c_str(), nullptr,
                                   nullptr);
        if (window_ == nullptr)
            throw Error(glfwReason(request.api == Api::es ? "no window with OpenGL ES 3.0"
                                                          : "no window with OpenGL 3.3 core"));
        glfwMakeContextCurrent(window_);
    }
    ~GlfwContext() override { glfwDestroyWindow(window_); }
    Backend backend() const override { return Backend::window; }
    GLFWwindow* window() const override { return window_; }

 private:
    GlfwLibrary library_;
    GLFWwindow* window_ = nullptr;
};

}  // namespace

BackendContext createGlfwContext(const ContextRequest& request) {
    return {std::make_unique<GlfwContext>(request), glfwGetProcAddress};
}

}  // namespace penumbra
