// The OpenGL functions this course uses, under their own names, and no more of them.
//
// No OpenGL library is linked: window, OSMesa and EGL each bring their own, and a program must start where
// two of the three are missing. So every function is a pointer in namespace penumbra, filled in by the back
// end that made the context. `glBindTexture(GL_TEXTURE_2D, id)` reads, and is called, as usual.
#pragma once

#include <GL/glcorearb.h>

#include "common/gl/gl_function_list.h"

namespace penumbra {

// clang-format off
#define PENUMBRA_DECLARE_GL(type, name) extern type name;
PENUMBRA_GL_CORE(PENUMBRA_DECLARE_GL)
PENUMBRA_GL_OPTIONAL(PENUMBRA_DECLARE_GL)
#undef PENUMBRA_DECLARE_GL
// clang-format on

using GlProcAddress = void (*)();
using GetGlProcAddress = GlProcAddress (*)(const char* name);

/// Fills in the function pointers from the current context. Throws Error naming the first core function that
/// is missing. Optional functions may stay null; `Capabilities` says which may be called.
void loadGlFunctions(GetGlProcAddress getProcAddress);

}  // namespace penumbra
