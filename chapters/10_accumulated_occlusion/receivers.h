// The surface points whose visibility is added up: a texel each, of textures that tell where they lie.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "chapters/08_accumulation/texel_target.h"
#include "common/app/chapter.h"
#include "common/gl/program.h"

namespace penumbra {

class Receivers {
 public:
    Receivers();

    /// What each pixel of the frame sees. Leaves framebuffer and viewport changed.
    void drawPixels(const Frame& frame);
    /// The scene's vertices, row by row: vertex i is texel (i % size().x, i / size().x).
    void uploadVertices(const Scene& scene);

    const glm::ivec2& size() const { return size_; }
    GLuint positions() const { return positions_->id(); }  ///< w: 1; 0: no surface
    GLuint normals() const { return normals_->id(); }      ///< shading normals, unit
    /// Normals of the triangles, unit; of vertices, which have several: the shading normals again.
    GLuint facets() const { return facets_->id(); }
    /// Shading normals of all receivers; 0 where there is no surface.
    std::vector<glm::vec4> readNormals() const;

    Program& program() { return surface_; }

 private:
    void resize(const glm::ivec2& size);

    Program surface_;
    glm::ivec2 size_{0};
    std::optional<TexelTexture> positions_, normals_, facets_;
    GlRenderbuffer depth_;
    GlFramebuffer framebuffer_;
};

}  // namespace penumbra
