// EGL without a surface: a GPU that has no display, or Mesa's software rasteriser. Also the way to OpenGL ES.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "common/error.h"
#include "common/gl/context_backends.h"
#include "common/system/dynamic_library.h"

namespace penumbra {
namespace {

struct EglFunctions {
    DynamicLibrary library{{"libEGL.so.1", "libEGL.so"}, "PENUMBRA_EGL_LIBRARY"};
    decltype(&eglGetProcAddress) getProcAddress =
        library.function<decltype(&eglGetProcAddress)>("eglGetProcAddress");
    decltype(&eglQueryString) queryString = library.function<decltype(&eglQueryString)>("eglQueryString");
    decltype(&eglInitialize) initialize = library.function<decltype(&eglInitialize)>("eglInitialize");
    decltype(&eglTerminate) terminate = library.function<decltype(&eglTerminate)>("eglTerminate");
    decltype(&eglBindAPI) bindApi = library.function<decltype(&eglBindAPI)>("eglBindAPI");
    decltype(&eglChooseConfig) chooseConfig = library.function<decltype(&eglChooseConfig)>("eglChooseConfig");
    decltype(&eglCreateContext) createContext =
        library.function<decltype(&eglCreateContext)>("eglCreateContext");
    decltype(&eglDestroyContext) destroyContext =
        library.function<decltype(&eglDestroyContext)>("eglDestroyContext");
    decltype(&eglMakeCurrent) makeCurrent = library.function<decltype(&eglMakeCurrent)>("eglMakeCurrent");
    decltype(&eglReleaseThread) releaseThread =
        library.function<decltype(&eglReleaseThread)>("eglReleaseThread");

    template <class Function>
    Function extension(const char* name) const {
        return reinterpret_cast<Function>(getProcAddress(name));
    }
};

/// Is `name` one of the space-separated words of `list`?
bool hasWord(const char* list, const char* name) {
    const std::size_t length = std::strlen(name);
    for (const char* at = list; at && (at = std::strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return true;
    return false;
}

/// Displays to try, best first: GPUs (hardware only: Mesa also lists its software rasteriser as a device),
/// then Mesa's surfaceless platform.
std::vector<EGLDisplay> candidateDisplays(const EglFunctions& egl) {
    const char* extensions = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto getPlatformDisplay =
        egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    std::vector<EGLDisplay> displays;
    if (!hasWord(extensions, "EGL_EXT_platform_base") || getPlatformDisplay == nullptr) return displays;
    if (hasWord(extensions, "EGL_EXT_platform_device") && hasWord(extensions, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        egl.extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT")(EGLint(devices.size()), devices.data(),
                                                                       &count);
        const auto queryDevice = egl.extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
        for (EGLint i = 0; i < count; ++i)
            if (!hasWord(queryDevice(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software"))
                displays.push_back(getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
    if (hasWord(extensions, "EGL_MESA_platform_surfaceless"))
        displays.push_back(getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    return displays;
}

class EglContext : public Context {
 public:
    explicit EglContext(Api api) {
        const std::vector<EGLDisplay> displays = candidateDisplays(egl_);
        if (displays.empty()) throw Error("EGL has neither a GPU device nor the surfaceless platform");
        std::string reason;
        for (EGLDisplay display : displays) {
            reason = tryDisplay(display, api);
            if (reason.empty()) return;
        }
        throw Error(reason);
    }
    ~EglContext() override { release(); }
    Backend backend() const override { return Backend::egl; }
    GetGlProcAddress getProcAddress() const { return egl_.getProcAddress; }

 private:
    /// Empty on success, else why not.
    std::string tryDisplay(EGLDisplay display, Api api) {
        if (display == EGL_NO_DISPLAY || !egl_.initialize(display, nullptr, nullptr))
            return "EGL could not be initialised";
        display_ = display;
        const std::string reason = makeContext(api);
        if (!reason.empty()) release();
        return reason;
    }

    std::string makeContext(Api api) {
        const bool es = api == Api::es;
        if (!hasWord(egl_.queryString(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
            return "EGL cannot make a context without a surface";
        if (!egl_.bindApi(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API)) return "EGL does not offer this API";
        const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
                                           es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!egl_.chooseConfig(display_, wanted.data(), &config, 1, &count) || count == 0)
            return "EGL has no configuration for this API";
        std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, es ? 0 : 3};
        if (!es)
            attributes.insert(attributes.end(),
                              {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT});
        attributes.push_back(EGL_NONE);
        context_ = egl_.createContext(display_, config, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT ||
            !egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            return es ? "EGL offers no OpenGL ES 3.0 context" : "EGL offers no OpenGL 3.3 core context";
        return {};
    }

    void release() {
        egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) egl_.destroyContext(display_, context_);
        egl_.terminate(display_);
        egl_.releaseThread();
        context_ = EGL_NO_CONTEXT;
        display_ = EGL_NO_DISPLAY;
    }

    EglFunctions egl_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

BackendContext createEglContext(const ContextRequest& request) {
    // What it cannot do is said in our one line; what it warns of on the way there only confuses.
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);
    auto context = std::make_unique<EglContext>(request.api);
    const GetGlProcAddress getProcAddress = context->getProcAddress();
    return {std::move(context), getProcAddress};
}

}  // namespace penumbra
