#include "common/error.h"
#include "common/gl/gl.h"

namespace penumbra {

// clang-format off
#define PENUMBRA_DEFINE_GL(type, name) type name = nullptr;
PENUMBRA_GL_CORE(PENUMBRA_DEFINE_GL)
PENUMBRA_GL_OPTIONAL(PENUMBRA_DEFINE_GL)
#undef PENUMBRA_DEFINE_GL
// clang-format on

namespace {

template <class Function>
void load(Function& function, const char* name, GetGlProcAddress getProcAddress, bool required) {
    function = reinterpret_cast<Function>(getProcAddress(name));
    if (required && function == nullptr)
        throw Error(std::string("the OpenGL driver has no ") + name +
                    ", which OpenGL 3.3 and OpenGL ES 3.0 must have; update the driver");
}

}  // namespace

void loadGlFunctions(GetGlProcAddress getProcAddress) {
#define PENUMBRA_LOAD_CORE(type, name) load(name, #name, getProcAddress, true);
#define PENUMBRA_LOAD_OPTIONAL(type, name) load(name, #name, getProcAddress, false);
    PENUMBRA_GL_CORE(PENUMBRA_LOAD_CORE)
    PENUMBRA_GL_OPTIONAL(PENUMBRA_LOAD_OPTIONAL)
#undef PENUMBRA_LOAD_CORE
#undef PENUMBRA_LOAD_OPTIONAL
}

}  // namespace penumbra
