// OpenGL objects alive in the current context, counted by asking the driver about every name.
#pragma once

#include <array>
#include <map>
#include <string>

#include "common/error.h"
#include "common/gl/gl_object.h"

namespace penumbra {

/// Kind of object -> how many names from 1 to 8191 are one. Drivers hand out the smallest name that is free,
/// and this is checked: an object whose name lies beyond would not be seen.
inline std::map<std::string, int> liveObjects() {
    constexpr GLuint beyond = 8192;
    if (GlTexture().id() >= beyond || GlBuffer().id() >= beyond || GlVertexArray().id() >= beyond ||
        GlFramebuffer().id() >= beyond || GlSampler().id() >= beyond || GlRenderbuffer().id() >= beyond)
        throw Error("names of objects grow beyond what is counted");
    std::map<std::string, int> count;
    for (GLuint name = 1; name < beyond; ++name) {
        count["textures"] += glIsTexture(name);
        count["buffers"] += glIsBuffer(name);
        count["vertex arrays"] += glIsVertexArray(name);
        count["framebuffers"] += glIsFramebuffer(name);
        count["renderbuffers"] += glIsRenderbuffer(name);
        count["samplers"] += glIsSampler(name);
        count["programs"] += glIsProgram(name);
        count["shaders"] += glIsShader(name);
    }
    return count;
}

}  // namespace penumbra
