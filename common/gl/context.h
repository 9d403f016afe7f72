// One function makes an OpenGL context, whatever the machine has: a window, OSMesa, or EGL without a surface.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

struct GLFWwindow;

namespace penumbra {

enum class Backend { automatic, window, osmesa, egl };
enum class Api { desktop, es };  ///< OpenGL 3.3 core, or OpenGL ES 3.0

struct ContextRequest {
    Backend backend = Backend::automatic;
    Api api = Api::desktop;
    bool headless = true;              ///< automatic: never try a window
    glm::ivec2 windowSize{1280, 800};  ///< window back end only, screen units
    std::string title = "Penumbra";
};

/// What the context can do beyond the common subset of OpenGL 3.3 and ES 3.0. Every use has a fallback.
struct Capabilities {
    Api api = Api::desktop;
    bool clipControl = false;       ///< glClipControl: reversed-Z is possible
    bool floatColorBuffer = false;  ///< RGBA32F and R32F can be rendered to
    bool floatBlend = false;        ///< ... and blended into
    bool multiDraw = false;         ///< glMultiDrawElements
    bool clampToBorder = false;
    bool depthClamp = false;
    bool timerQuery = false;
    bool polygonOffsetClamp = false;  ///< glPolygonOffsetClamp
    bool logicOp = false;             ///< glLogicOp (not in ES)
    bool textureGather = false;       ///< GL_ARB_texture_gather: four texels in one look-up
};

/// A current OpenGL context. One per process at a time. Destroying it releases everything.
class Context {
 public:
    virtual ~Context() = default;
    virtual Backend backend() const = 0;
    virtual GLFWwindow* window() const { return nullptr; }
    const Capabilities& capabilities() const { return capabilities_; }
    const std::string& renderer() const { return renderer_; }  ///< GL_RENDERER
    const std::string& version() const { return version_; }    ///< GL_VERSION

 protected:
    friend std::unique_ptr<Context> createContext(const ContextRequest&);
    Capabilities capabilities_;
    std::string renderer_;
    std::string version_;
};

/// Makes a context, makes it current, loads the GL functions, turns KHR_debug errors into exceptions at the
/// next `checkGlErrors`. Throws Error with ONE line naming every back end tried, why each failed, and what to
/// install.
std::unique_ptr<Context> createContext(const ContextRequest& request);

const char* backendName(Backend backend);  ///< "auto", "window", "osmesa", "egl"
const char* apiName(Api api);              ///< "desktop", "es"

}  // namespace penumbra
