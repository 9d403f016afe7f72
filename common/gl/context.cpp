#include "common/gl/context.h"

#include <fmt/format.h>

#include <cstdlib>
#include <set>
#include <vector>

#include "common/error.h"
#include "common/gl/context_backends.h"
#include "common/gl/gl_errors.h"

namespace penumbra {
namespace {

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

std::set<std::string> glExtensions() {
    std::set<std::string> extensions;
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* name = glGetStringi(GL_EXTENSIONS, GLuint(i));
        if (name) extensions.insert(reinterpret_cast<const char*>(name));
    }
    return extensions;
}

/// Version and extensions decide, never the pointer: EGL hands out non-null pointers for functions a context
/// lacks.
class Features {
 public:
    explicit Features(Api api) : es_(api == Api::es), extensions_(glExtensions()) {
        GLint major = 0;
        GLint minor = 0;
        glGetIntegerv(GL_MAJOR_VERSION, &major);
        glGetIntegerv(GL_MINOR_VERSION, &minor);
        version_ = 10 * major + minor;
    }
    bool tooOld() const { return version_ < (es_ ? 30 : 33); }
    /// In the core of desktop OpenGL `desktopVersion` (33, 45, ...; 0: never), or an extension.
    bool has(int desktopVersion, std::initializer_list<const char*> extensions) const {
        if (!es_ && desktopVersion != 0 && version_ >= desktopVersion) return true;
        for (const char* name : extensions)
            if (extensions_.count(name) != 0) return true;
        return false;
    }

 private:
    bool es_;
    int version_ = 0;
    std::set<std::string> extensions_;
};

/// Functions that ES, or an older desktop version, offers only under an extension's name.
template <class Function>
void useName(Function& function, bool available, std::initializer_list<const char*> names,
             GetGlProcAddress getProcAddress) {
    if (!available) function = nullptr;
    for (const char* name : names)
        if (available && function == nullptr) function = reinterpret_cast<Function>(getProcAddress(name));
}

Capabilities findCapabilities(Api api, const Features& features, GetGlProcAddress getProcAddress) {
    useName(glClipControl, features.has(45, {"GL_ARB_clip_control", "GL_EXT_clip_control"}),
            {"glClipControlEXT"}, getProcAddress);
    useName(glMultiDrawElements, features.has(14, {"GL_EXT_multi_draw_arrays"}), {"glMultiDrawElementsEXT"},
            getProcAddress);
    useName(glPolygonOffsetClamp,
            features.has(46, {"GL_ARB_polygon_offset_clamp", "GL_EXT_polygon_offset_clamp"}),
            {"glPolygonOffsetClampEXT"}, getProcAddress);
    useName(glDebugMessageCallback, features.has(43, {"GL_KHR_debug"}), {"glDebugMessageCallbackKHR"},
            getProcAddress);
    useName(glLogicOp, features.has(11, {}), {}, getProcAddress);

    Capabilities capabilities;
    capabilities.api = api;
    capabilities.clipControl = glClipControl != nullptr;
    capabilities.floatColorBuffer = features.has(30, {"GL_EXT_color_buffer_float"});
    capabilities.floatBlend = capabilities.floatColorBuffer && features.has(30, {"GL_EXT_float_blend"});
    capabilities.multiDraw = glMultiDrawElements != nullptr;
    capabilities.clampToBorder = features.has(
        13, {"GL_EXT_texture_border_clamp", "GL_OES_texture_border_clamp", "GL_NV_texture_border_clamp"});
    capabilities.depthClamp = features.has(32, {"GL_ARB_depth_clamp", "GL_EXT_depth_clamp"});
    capabilities.timerQuery = features.has(33, {"GL_EXT_disjoint_timer_query"});
    capabilities.polygonOffsetClamp = glPolygonOffsetClamp != nullptr;
    capabilities.logicOp = glLogicOp != nullptr;
    // By its extension alone: shaders are version 330, and have to name it.
    capabilities.textureGather = features.has(0, {"GL_ARB_texture_gather"});
    return capabilities;
}

struct BackendEntry {
    Backend backend;
    BackendContext (*create)(const ContextRequest&);
    const char* advice;
};

const BackendEntry backendTable[] = {
    {Backend::window, createGlfwContext, "run it with a display"},
    {Backend::osmesa, createOsmesaContext, "install libosmesa6"},
    {Backend::egl, createEglContext, "install libegl1 and libgl1-mesa-dri"},
};

std::vector<BackendEntry> backendsToTry(const ContextRequest& request) {
    std::vector<BackendEntry> entries;
    for (const BackendEntry& entry : backendTable) {
        const bool inAutomatic = entry.backend != Backend::window || !request.headless;
        if (request.backend == entry.backend || (request.backend == Backend::automatic && inAutomatic))
            entries.push_back(entry);
    }
    return entries;
}

/// Mesa's software rasterisers end with a segmentation fault on values of these that they do not know.
void requireKnownDrivers(Backend backend) {
    const auto require = [](const char* variable, const std::set<std::string>& known) {
        const char* value = std::getenv(variable);
        if (!value || !*value || known.contains(value)) return;
        std::string names;
        for (const std::string& name : known) names += (names.empty() ? "" : " or ") + name;
        throw Error(fmt::format("the environment variable {} is \"{}\": unset it, or set it to {}", variable,
                                value, names));
    };
    require("LP_NATIVE_VECTOR_WIDTH", {"128", "256", "512"});
    if (backend == Backend::osmesa) require("GALLIUM_DRIVER", {"llvmpipe", "softpipe"});
}

[[noreturn]] void refuse(const ContextRequest& request, const std::vector<BackendEntry>& tried,
                         const std::vector<std::string>& reasons) {
    std::string what;
    std::string advice;
    for (std::size_t i = 0; i < tried.size(); ++i) {
        what += fmt::format("{}{}: {}", i ? "; " : "", backendName(tried[i].backend), reasons[i]);
        advice += fmt::format("{}{}", i ? ", or " : "", tried[i].advice);
    }
    throw Error(fmt::format("no {} context ({}): {}",
                            request.api == Api::es ? "OpenGL ES 3.0" : "OpenGL 3.3 core", what, advice));
}

}  // namespace

std::unique_ptr<Context> createContext(const ContextRequest& request) {
    const std::vector<BackendEntry> entries = backendsToTry(request);
    std::vector<std::string> reasons;
    for (const BackendEntry& entry : entries) {
        try {
            requireKnownDrivers(entry.backend);
            BackendContext made = entry.create(request);
            loadGlFunctions(made.getProcAddress);
            const Features features(request.api);
            made.context->version_ = glText(GL_VERSION);
            made.context->renderer_ = glText(GL_RENDERER);
            if (features.tooOld()) throw Error("its version is only " + made.context->version_);
            made.context->capabilities_ = findCapabilities(request.api, features, made.getProcAddress);
            listenForGlErrors();
            return std::move(made.context);
        } catch (const Error& error) {
            reasons.push_back(error.what());
        }
    }
    refuse(request, entries, reasons);
}

const char* backendName(Backend backend) {
    switch (backend) {
        case Backend::window:
            return "window";
        case Backend::osmesa:
            return "osmesa";
        case Backend::egl:
            return "egl";
        default:
            return "auto";
    }
}

const char* apiName(Api api) {
    return api == Api::es ? "es" : "desktop";
}

}  // namespace penumbra
