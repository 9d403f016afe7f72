// OpenGL objects alive in the current context, counted by asking the driver about every name.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "common/gl/gl_object.h"

namespace penumbra {

/// A name that was not in use, larger than all before where the driver counts upwards (Mesa) and does not
/// give freed names away again.
inline GLuint newestName() {
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER);
    glDeleteShader(shader);
    return std::max({shader, GlTexture().id(), GlBuffer().id(), GlVertexArray().id(), GlFramebuffer().id(),
                     GlSampler().id(), GlRenderbuffer().id()});
}

/// Kind of object -> how many names are one.
inline std::map<std::string, int> liveObjects() {
    const std::map<std::string, GLboolean (*)(GLuint)> kinds{
        {"textures", [](GLuint name) { return glIsTexture(name); }},
        {"buffers", [](GLuint name) { return glIsBuffer(name); }},
        {"vertex arrays", [](GLuint name) { return glIsVertexArray(name); }},
        {"framebuffers", [](GLuint name) { return glIsFramebuffer(name); }},
        {"renderbuffers", [](GLuint name) { return glIsRenderbuffer(name); }},
        {"samplers", [](GLuint name) { return glIsSampler(name); }},
        {"programs", [](GLuint name) { return glIsProgram(name); }},
        {"shaders", [](GLuint name) { return glIsShader(name); }}};
    constexpr GLuint plenty = 4096;  // for drivers that give the smallest free name
    const GLuint last = std::max(plenty, newestName());
    std::map<std::string, int> count;
    for (const auto& [kind, isOne] : kinds)
        for (GLuint name = 1; name <= last; ++name) count[kind] += isOne(name) == GL_TRUE;
    return count;
}

}  // namespace penumbra
