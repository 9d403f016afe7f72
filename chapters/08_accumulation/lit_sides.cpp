#include "chapters/08_accumulation/lit_sides.h"

#include "common/gl/gl.h"

namespace penumbra {

// [begin:lit-sides]
void drawLitSides(const std::vector<Receiver>& receivers, const std::function<bool(std::size_t)>& lit,
                  const std::function<void(std::size_t)>& draw) {
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_CULL_FACE);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        if (!lit(i)) continue;
        glCullFace(receivers[i].back ? GL_FRONT : GL_BACK);
        draw(i);
    }
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LESS);
}
// [end:lit-sides]

}  // namespace penumbra
