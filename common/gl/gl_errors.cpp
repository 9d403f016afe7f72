#include "common/gl/gl_errors.h"

#include <fmt/format.h>

#include <cstring>
#include <string>

#include "common/error.h"
#include "common/gl/gl_object.h"

namespace penumbra {
namespace {

// Written by the driver's callback. It must not throw there: the exception would have to pass through the
// driver's frames. A fixed buffer, because allocating may throw too.
char pendingMessage[512] = "";

void APIENTRY onDebugMessage(GLenum source, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                             const void*) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;  // Program reports these, with the file and line
    if (type != GL_DEBUG_TYPE_ERROR || pendingMessage[0] != '\0') return;  // the first error is the cause
    std::strncpy(pendingMessage, message, sizeof(pendingMessage) - 1);
}

const char* errorName(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY:
            return "GL_OUT_OF_MEMORY";
        default:
            return "unknown GL error";
    }
}

const char* incompletenessName(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_UNDEFINED:
            return "GL_FRAMEBUFFER_UNDEFINED";
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT";
        case GL_FRAMEBUFFER_UNSUPPORTED:
            return "GL_FRAMEBUFFER_UNSUPPORTED";
        case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
            return "GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE";
        default:
            return "unknown status";
    }
}

}  // namespace

void listenForGlErrors() {
    pendingMessage[0] = '\0';
    if (glDebugMessageCallback == nullptr) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onDebugMessage, nullptr);
}

void discardGlErrors() {
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {  // a lost context reports errors for ever
    }
    pendingMessage[0] = '\0';
}

void checkGlErrors(const char* where) {
    const GLenum first = glGetError();
    const std::string message = pendingMessage;
    discardGlErrors();
    if (first == GL_NO_ERROR && message.empty()) return;
    throw Error(fmt::format("OpenGL error {}: {}", where, message.empty() ? errorName(first) : message));
}

void requireCompleteFramebuffer(const char* what) {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    throw Error(fmt::format("OpenGL cannot render to {}: {}; this driver lacks one of its formats", what,
                            incompletenessName(status)));
}

}  // namespace penumbra
