// Compiling and linking; private to common/gl.
#pragma once

#include <string>

#include "common/gl/context.h"
#include "common/gl/gl.h"
#include "common/gl/shader_source.h"

namespace penumbra {

/// Of the context that is current.
Api currentApi();

/// A new linked program, the caller's to delete. Throws Error: file:line: message, or `names` do not link.
GLuint linkProgram(const ShaderSource& vertex, const ShaderSource& fragment, const std::string& names);

}  // namespace penumbra
