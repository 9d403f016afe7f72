// From a shader file on disk to the text the driver compiles, and from the driver's messages back to the
// file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/gl/context.h"
#include "common/gl/gl.h"

namespace penumbra {

/// The folder shader names are relative to: $PENUMBRA_SHADERS, or `shaders/` of the source tree.
std::filesystem::path shaderRoot();

/// One stage, ready to compile.
struct ShaderSource {
    std::string text;                ///< version line, precision, defines, files with #include resolved
    std::vector<std::string> files;  ///< the name of source-string number i, as #line counts them
    std::map<std::string, GLenum> constants;  ///< uniforms that became constants, and their types
};

/// Reads `file` and what it includes (each file once). Every path opened is appended to `opened`, also when
/// this throws, so that hot reload can watch the file that is wrong. Throws Error: missing file (and who
/// includes it), include cycle.
/// `constants`: uniforms that become constants, and their values in GLSL; those that are declared on a line
/// of their own.
ShaderSource loadShaderSource(const std::string& file, const std::vector<std::string>& defines, Api api,
                              std::vector<std::filesystem::path>& opened,
                              const std::map<std::string, std::string>& constants = {});

/// The driver's log with source-string numbers replaced by names: "0:12(5): error: x" becomes
/// "shaders/a.frag:12: error: x". Understands the notations of Mesa and Apple ("0:12"), AMD and ANGLE
/// ("ERROR: 0:12:"), and NVIDIA ("0(12) :").
std::string nameFilesInLog(const std::string& log, const std::vector<std::string>& files);

/// The uniforms declared in `text`, used or not: name to GL type (GL_FLOAT_VEC3, GL_SAMPLER_2D, ...).
/// Conditional compilation is not evaluated.
std::map<std::string, GLenum> declaredUniforms(const std::string& text);

/// "vec3" from GL_FLOAT_VEC3; a number for types that the course doesn't use.
std::string glslTypeName(GLenum type);

}  // namespace penumbra
