// How far a depth may be from the exact one, derived: format, arithmetic and rasteriser.
#pragma once

#include "chapters/01_depth_from_light/depth_format.h"
#include "chapters/01_depth_from_light/light_frustum.h"

namespace penumbra {

/// Window depth unless said otherwise.
struct DepthErrors {
    glm::vec2 quantum{0.0f};      ///< of the stored depth: absolute, and relative to the depth
    float snap = 0.0f;            ///< texels a rasteriser may move a vertex by: half of 2^-GL_SUBPIXEL_BITS
    glm::vec3 rounding{0.0f};     ///< of s and t, of r, and of q, before the division by q
    glm::vec2 rasterError{0.0f};  ///< of an interpolated depth: absolute, and relative
};

/// Errors of depths that went through `operations` float operations in a row: a vertex transform is
/// `transformOperations`. `bounds`: of everything that is transformed. n additions and products are off by at
/// most n 2^-24 times the sum of the absolute values (Higham, "Accuracy and Stability of Numerical
/// Algorithms", 2002). Needs a context.
DepthErrors depthErrors(DepthFormat format, const LightFrustum& frustum, const Aabb& bounds, int operations);

/// The matrix's own rounding, then four products and three sums of which no term sees more than four.
inline constexpr int transformOperations = 5;

/// What a texel whose centre sees a plane of window depth `z` at `eyeDepth` metres may be off by: one
/// quantum, the arithmetic, and the slope (dz/du, dz/dv over the whole map) times the rasteriser's subpixel
/// step.
double texelDepthError(const DepthErrors& errors, double z, double eyeDepth, bool orthographic,
                       const glm::dvec2& slope, int mapSize);

}  // namespace penumbra
