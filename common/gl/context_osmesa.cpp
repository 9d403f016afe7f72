// OSMesa: Mesa's software rasteriser without any window system. Removed from Mesa 25.1 on, hence optional.
#include "common/error.h"
#include "common/gl/context_backends.h"

#ifdef PENUMBRA_WITH_OSMESA

#include <GL/osmesa.h>

#include <array>

#include "common/system/dynamic_library.h"

namespace penumbra {
namespace {

struct OsmesaFunctions {
    DynamicLibrary library{{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, "PENUMBRA_OSMESA_LIBRARY"};
    decltype(&OSMesaCreateContextAttribs) createContextAttribs =
        library.function<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
    decltype(&OSMesaMakeCurrent) makeCurrent =
        library.function<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    decltype(&OSMesaDestroyContext) destroyContext =
        library.function<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext");
    decltype(&OSMesaGetProcAddress) getProcAddress =
        library.function<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
};

class OsmesaContext : public Context {
 public:
    OsmesaContext() {
        const std::array<int, 11> attributes{OSMESA_FORMAT,
                                             OSMESA_RGBA,
                                             OSMESA_PROFILE,
                                             OSMESA_CORE_PROFILE,
                                             OSMESA_CONTEXT_MAJOR_VERSION,
                                             3,
                                             OSMESA_CONTEXT_MINOR_VERSION,
                                             3,
                                             0};
        context_ = functions_.createContextAttribs(attributes.data(), nullptr);
        if (context_ == nullptr) throw Error("OSMesa offers no OpenGL 3.3 core context");
        if (!functions_.makeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
            functions_.destroyContext(context_);
            throw Error("OSMesa could not make its context current");
        }
    }
    ~OsmesaContext() override { functions_.destroyContext(context_); }
    Backend backend() const override { return Backend::osmesa; }
    GetGlProcAddress getProcAddress() const { return functions_.getProcAddress; }

 private:
    OsmesaFunctions functions_;
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4>
        pixel_{};  // OSMesa insists on a default framebuffer; nothing is drawn into it
};

}  // namespace

BackendContext createOsmesaContext(const ContextRequest& request) {
    if (request.api == Api::es) throw Error("OSMesa has no OpenGL ES");
    auto context = std::make_unique<OsmesaContext>();
    const GetGlProcAddress getProcAddress = context->getProcAddress();
    return {std::move(context), getProcAddress};
}

}  // namespace penumbra

#else

namespace penumbra {

BackendContext createOsmesaContext(const ContextRequest&) {
    throw Error("this program was built with PENUMBRA_WITH_OSMESA=OFF");
}

}  // namespace penumbra

#endif
