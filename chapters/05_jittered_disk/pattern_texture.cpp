#include "chapters/05_jittered_disk/pattern_texture.h"

#include <vector>

namespace penumbra {

// [begin:upload]
PatternTexture::PatternTexture(std::span<const glm::dvec2> points) {
    const std::vector<glm::vec2> texels(points.begin(), points.end());
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, GLsizei(texels.size()), 1, 0, GL_RG, GL_FLOAT, texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}
// [end:upload]

}  // namespace penumbra
