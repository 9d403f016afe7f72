// Passes over a whole picture.
#pragma once

#include "common/gl/gl_object.h"

namespace penumbra {

/// The triangle of shaders/common/fullscreen.vert. It has no attributes, but core OpenGL draws nothing
/// without a vertex array.
class FullscreenTriangle {
 public:
    /// The caller has prepared its program, framebuffer and viewport.
    void draw() const {
        glBindVertexArray(array_.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

 private:
    GlVertexArray array_;
};

}  // namespace penumbra
