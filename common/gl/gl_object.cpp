#include "common/gl/gl_object.h"

namespace penumbra {

GLuint TextureTraits::create() {
    GLuint id = 0;
    glGenTextures(1, &id);
    return id;
}
void TextureTraits::destroy(GLuint id) {
    glDeleteTextures(1, &id);
}

GLuint BufferTraits::create() {
    GLuint id = 0;
    glGenBuffers(1, &id);
    return id;
}
void BufferTraits::destroy(GLuint id) {
    glDeleteBuffers(1, &id);
}

GLuint VertexArrayTraits::create() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    return id;
}
void VertexArrayTraits::destroy(GLuint id) {
    glDeleteVertexArrays(1, &id);
}

GLuint FramebufferTraits::create() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    return id;
}
void FramebufferTraits::destroy(GLuint id) {
    glDeleteFramebuffers(1, &id);
}

GLuint SamplerTraits::create() {
    GLuint id = 0;
    glGenSamplers(1, &id);
    return id;
}
void SamplerTraits::destroy(GLuint id) {
    glDeleteSamplers(1, &id);
}

GLuint RenderbufferTraits::create() {
    GLuint id = 0;
    glGenRenderbuffers(1, &id);
    return id;
}
void RenderbufferTraits::destroy(GLuint id) {
    glDeleteRenderbuffers(1, &id);
}

}  // namespace penumbra
