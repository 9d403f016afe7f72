// What a shadow map can hold, without drawing one: exact depths in double, and where edges make them unsure.
#pragma once

#include <vector>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "chapters/01_depth_from_light/light_frustum.h"
#include "common/scene/scene.h"
#include "tests/stress/projected_triangle.h"

namespace penumbra::stress {

/// Window depth.
struct StoredDepth {
    double low = 0.0, high = 1.0;  ///< the least and the most that is right
    double exact = 1.0;            ///< behind the texel's centre; of the far plane where there is nothing
    bool sure = true;              ///< no edge is so near that another surface may be stored
};

/// Of the ground, which is the scene's triangle 0.
struct TexelShadow {
    bool open = true;  ///< nothing that may be drawn there is nearer to the light than the ground
    /// Towards larger means farther: a depth by more than the bias beyond this is in shadow. Infinite where
    /// nothing surely covers the texel's centre.
    double dark = 0.0;
};

/// Keeps nothing of the scene. `onePass`: depthErrors of a vertex transform.
class MapOracle {
 public:
    MapOracle(const Scene& scene, const LightFrustum& frustum, int mapSize, const DepthErrors& onePass);

    StoredDepth stored(const glm::ivec2& texel) const;
    TexelShadow shadow(const glm::ivec2& texel) const;
    /// Larger is farther from the light, whatever the format.
    double farther(double windowDepth) const { return sign_ * windowDepth; }

 private:
    struct Layer {
        double depth, error;
    };
    Layer layer(const ProjectedTriangle& triangle, const glm::dvec2& at) const;
    double nearestOf(const ProjectedTriangle& triangle) const;

    std::vector<ProjectedTriangle> triangles_;
    DepthErrors errors_;
    int mapSize_;
    bool orthographic_;
    double sign_, near_, far_;
};

}  // namespace penumbra::stress
