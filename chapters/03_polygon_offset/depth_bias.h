// How far a depth may be off, and what each remedy asks of the two passes.
#pragma once

#include <string>
#include <vector>

#include "chapters/01_depth_from_light/shadow_map.h"

namespace penumbra {

/// The order is that of the constants in biased.frag.
enum class BiasMethod {
    none,
    constant,
    polygonOffset,
    slope,
    receiverPlane,
    normalOffset,
    frontFace,
    midpoint
};

const std::vector<std::string>& biasMethodNames();
/// Throws UsageError for an unknown name.
BiasMethod biasMethod(const std::string& name);

/// What the bound B = S + Q + C is made of besides the receiver's slope. Window depth unless said otherwise.
struct DepthErrors {
    glm::vec2 quantum{0.0f};   ///< Q: absolute, and relative to the depth
    float snap = 0.0f;         ///< texels a rasteriser may move a vertex by: half of 2^-GL_SUBPIXEL_BITS
    glm::vec3 rounding{0.0f};  ///< C: errors of s and t, of r, of q before the division, both passes together
    glm::vec2 rasterError{0.0f};  ///< C: of an interpolated depth, absolute and relative
    float constant = 0.0f;  ///< the slides' epsilon: B of a plane at 60 degrees in the middle of the frustum
};

/// `bounds`: of everything that is transformed. Rounding analysis after Higham, "Accuracy and Stability of
/// Numerical Algorithms" (2002): n terms added in float are off by at most n 2^-24 times the sum of their
/// absolute values.
DepthErrors depthErrors(const ShadowMap& map, const LightFrustum& frustum, const Aabb& bounds);

/// How `method` draws the casters: culling and glPolygonOffset. `scale` multiplies factor and units.
CasterDraw casterDraw(BiasMethod method, const ShadowMap& map, const LightFrustum& frustum,
                      const DepthErrors& errors, float scale);

}  // namespace penumbra
