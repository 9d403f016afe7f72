#include "chapters/04_pcf/compare_sampler.h"

namespace penumbra {

// [begin:compare-sampler]
CompareSampler::CompareSampler(DepthRange range, GLenum filter) {
    const GLuint s = sampler_.id();
    const GLenum nearerOrEqual = range == DepthRange::reversed ? GL_GEQUAL : GL_LEQUAL;
    glSamplerParameteri(s, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(s, GL_TEXTURE_COMPARE_FUNC, GLint(nearerOrEqual));
    glSamplerParameteri(s, GL_TEXTURE_MIN_FILTER, GLint(filter));  // of the results, never of the depths
    glSamplerParameteri(s, GL_TEXTURE_MAG_FILTER, GLint(filter));
    glSamplerParameteri(s, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(s, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}
// [end:compare-sampler]

}  // namespace penumbra
