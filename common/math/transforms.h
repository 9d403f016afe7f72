// Transforms, composed in double and rounded to float only when handed to the GPU.
//
// Conventions, stated once: right-handed, Y up, metres. Matrices act on column vectors and are named
// destinationFromSource, so that products read by cancellation: clipFromWorld = clipFromView * viewFromWorld.
// View space looks along -Z. Clip space is OpenGL's, z_ndc in [-1, 1], unless `DepthRange::reversed` is asked
// for: then z_ndc in [0, 1] with 1 at the near plane (needs glClipControl). Texture u runs right, v runs up.
#pragma once

#include <glm/glm.hpp>

namespace penumbra {

/// `standard`: z_ndc -1 (near) .. 1 (far). `reversed`: z_ndc 1 (near) .. 0 (far), for 32F depth with
/// glClipControl (N. Reed, "Depth Precision Visualized", 2015): the float exponent then compensates the 1/z
/// of perspective.
enum class DepthRange { standard, reversed };

/// Perspective frustum. `verticalFov` full angle in radians, 0 < near < far, aspect = width / height.
/// far may be infinite.
glm::dmat4 perspective(double verticalFov, double aspect, double near, double far,
                       DepthRange range = DepthRange::standard);

/// Box frustum [left, right] x [bottom, top] x [-far, -near] of view space.
glm::dmat4 orthographic(double left, double right, double bottom, double top, double near, double far,
                        DepthRange range = DepthRange::standard);

/// Rigid transform that puts `eye` at the origin and `forward` on -Z. `forward` need not be unit; if `up` is
/// parallel to it another axis is chosen, so the result is always a rotation.
glm::dmat4 viewFromWorld(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up = {0, 1, 0});

/// Maps clip space to ([0,1]^2 texture, [0,1] window depth), before the division by w. With
/// `DepthRange::reversed` z is passed through, since it is in [0, 1] already.
glm::dmat4 textureFromClip(DepthRange range = DepthRange::standard);

/// Texture-space depth slope of a plane: for the plane through `p` with normal `n` (both world), seen through
/// `textureFromWorld`, returns (dz/du, dz/dv) with u, v in [0,1] texture units. Exact for planes (window
/// depth is affine in window position even under perspective). Infinite or huge when the plane is edge-on to
/// the light.
glm::dvec2 depthSlope(const glm::dmat4& textureFromWorld, const glm::dvec3& p, const glm::dvec3& n);

}  // namespace penumbra
