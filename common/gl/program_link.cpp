#include "common/gl/program_link.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "common/error.h"

namespace penumbra {
namespace {

/// Deleted at the end of the scope; OpenGL keeps a shader alive while a program holds it.
struct Shader {
    GLuint id;
    explicit Shader(GLenum stage) : id(glCreateShader(stage)) {}
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { glDeleteShader(id); }
};

/// Deleted at the end of the scope unless released.
struct UnfinishedProgram {
    GLuint id = glCreateProgram();
    UnfinishedProgram() = default;
    UnfinishedProgram(const UnfinishedProgram&) = delete;
    UnfinishedProgram& operator=(const UnfinishedProgram&) = delete;
    ~UnfinishedProgram() { glDeleteProgram(id); }
    GLuint release() { return std::exchange(id, 0); }
};

template <class GetValue, class GetLog>
std::string infoLog(GLuint id, GetValue getValue, GetLog getLog) {
    GLint length = 0;
    getValue(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    getLog(id, GLsizei(log.size()), nullptr, log.data());
    return log.c_str();
}

void compile(const Shader& shader, const ShaderSource& source) {
    const char* text = source.text.c_str();
    glShaderSource(shader.id, 1, &text, nullptr);
    glCompileShader(shader.id);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id, GL_COMPILE_STATUS, &compiled);
    if (!compiled)
        throw Error(nameFilesInLog(infoLog(shader.id, glGetShaderiv, glGetShaderInfoLog), source.files));
}

}  // namespace

Api currentApi() {
    const std::string_view version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    return version.substr(0, 9) == "OpenGL ES" ? Api::es : Api::desktop;
}

GLuint linkProgram(const ShaderSource& vertex, const ShaderSource& fragment, const std::string& names) {
    const Shader vertexShader(GL_VERTEX_SHADER);
    compile(vertexShader, vertex);
    const Shader fragmentShader(GL_FRAGMENT_SHADER);
    compile(fragmentShader, fragment);
    UnfinishedProgram program;
    glAttachShader(program.id, vertexShader.id);
    glAttachShader(program.id, fragmentShader.id);
    glLinkProgram(program.id);
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id, GL_LINK_STATUS, &linked);
    if (!linked)
        throw Error(names + " do not link: " + infoLog(program.id, glGetProgramiv, glGetProgramInfoLog));
    return program.release();
}

}  // namespace penumbra
