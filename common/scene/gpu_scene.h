// The scene on the GPU: vertex buffers, textures, and the two ways of drawing it.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/gl/context.h"
#include "common/gl/gl_object.h"
#include "common/gl/program.h"
#include "common/scene/culling.h"
#include "common/scene/scene.h"

namespace penumbra {

/// Counts of what was submitted by one draw.
struct DrawCounts {
    std::size_t triangles = 0;
    std::size_t drawCalls = 0;
};

/// Attribute locations in every vertex shader: 0 position (vec3), 1 normal (vec3), 2 uv (vec2).
class GpuScene {
 public:
    GpuScene(const Scene& scene, const Capabilities& capabilities);

    /// Depth-only: positions alone, through an index buffer in which equal positions are one vertex
    /// (meshoptimizer). Closed parts are drawn with back faces culled when `cullClosed` is true (front faces
    /// if `frontFacesInstead`). Leaves culling disabled. The caller has prepared its program.
    ///
    /// Culling clusters is exact, to the bit. Culling back faces is exact in coverage, but not in the last
    /// digits of depth: along a silhouette front and back meet, and about one such pixel in a thousand finds
    /// the back nearer by a rounding error. So it is part of how a map is drawn, and not switched by
    /// --skip-none.
    struct DepthDraw {
        const VisibleClusters* visible = nullptr;
        bool cullClosed = true;
        bool frontFacesInstead =
            false;            ///< cull front faces of closed parts: chapter 03's front-face culling
        int exceptPart = -1;  ///< a light's own surface
        int instances = 1;    ///< how often each triangle is drawn: gl_InstanceID tells which
    };
    DrawCounts drawDepth(const DepthDraw& draw) const;
    /// What drawDepth draws from: a caller may add per-instance attributes from location 3 on.
    GLuint depthArray() const { return depthArray_.id(); }
    /// What drawShaded draws from: a caller may add per-vertex attributes from location 3 on.
    GLuint shadedArray() const { return shadedArray_.id(); }

    /// Full attributes, one material at a time: sets the uniforms of shaders/common/material.glsl on
    /// `program` before each draw (uDiffuse, uSpecular, uShininess, uEmission, uDiffuseTexture, uHasTexture).
    DrawCounts drawShaded(Program& program, const VisibleClusters& visible) const;
    /// The same for triangles of one part, whatever their clusters.
    DrawCounts drawShaded(Program& program, int part, const std::vector<IndexRange>& ranges) const;

    const Scene& scene() const { return *scene_; }

 private:
    void drawMaterial(Program& program, int index, const std::vector<IndexRange>& ranges,
                      DrawCounts& counts) const;
    void drawRanges(const std::vector<IndexRange>& ranges, DrawCounts& counts, int instances = 1) const;

    const Scene* scene_;
    Capabilities capabilities_;
    GlBuffer positions_, normals_, uvs_, indices_, depthIndices_;
    GlVertexArray shadedArray_, depthArray_;
    std::vector<GlTexture> textures_;
    GlTexture white_;
};

}  // namespace penumbra
