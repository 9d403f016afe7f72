// The light as a camera: its pose, its frustum, and what one texel and one depth value mean in metres.
#pragma once

#include <glm/glm.hpp>

#include "common/math/transforms.h"
#include "common/scene/camera.h"
#include "common/scene/light.h"
#include "common/scene/scene.h"

namespace penumbra {

/// A symmetric frustum looking along the light's axis. Everything in double: a shadow map compares two depths
/// that should be equal, so digits lost here come back as stripes of acne.
struct LightFrustum {
    bool orthographic = false;  ///< directional light
    DepthRange range = DepthRange::standard;
    glm::dvec3 eye{0.0};                 ///< the light; orthographic: a point on the axis of the box
    glm::dmat4 lightViewFromWorld{1.0};  ///< light view looks along -Z
    /// perspective: tangents of the half angles; orthographic: half sizes in metres. x right, y up.
    glm::dvec2 halfExtent{1.0};
    double near = 0.1;  ///< metres along the axis from `eye` (orthographic: may be negative)
    double far = 100.0;

    /// The near plane cuts casters: a closed one shows its inside, and its back faces must be drawn.
    bool cutsCasters = false;

    glm::dmat4 clipFromWorld() const;
    /// To ([0,1]^2, window depth), before the division by q.
    glm::dmat4 textureFromWorld() const;
    /// Metres along the axis -> window depth in [0,1], and back.
    double windowDepth(double eyeDepth) const;
    double eyeDepth(double windowDepth) const;
    /// Size in metres of one texel of a mapSize^2 map on the plane `eyeDepth` metres away (u, v).
    glm::dvec2 texelSize(double eyeDepth, int mapSize) const;
    /// The ray through `uv` of the map, starting on the near plane: a hit at t lies at eye depth near + t.
    Ray ray(const glm::dvec2& uv) const;
    /// Distance of `x` in front of the light along its axis, metres.
    double axisDistance(const glm::dvec3& x) const;

    bool operator==(const LightFrustum&) const = default;
};

/// Fits the frustum to what matters: laterally to the surfaces that the light reaches, `far` to the last of
/// these receivers, `near` to the first caster in front of them. Depth resolution is proportional to near,
/// lateral resolution to the extent: a frustum twice too wide costs as much as half the map. A point light is
/// aimed at its receivers and can hold at most `widestHalfAngle` of them to each side; what does not fit is
/// "outside the map" (chapter 02 decides what that means). A spot light keeps its axis, an area light counts
/// as a point at its centre.
LightFrustum fitLightFrustum(const Scene& scene, const Light& light, DepthRange range = DepthRange::standard);

/// The same, to the surfaces that the camera sees as well (`aspect` = width / height of its picture): finer
/// texels, but a map for each pose of the camera, and edges that crawl while it moves.
LightFrustum fitLightFrustum(const Scene& scene, const Light& light, const Camera& camera, double aspect,
                             DepthRange range = DepthRange::standard);

/// Half angle in radians of the widest frustum that a single map is asked to hold (75 degrees: beyond, the
/// texels in the middle are worth less than a sixteenth of the map).
inline constexpr double widestHalfAngle = 1.3089969389957472;

/// Casters nearer to a point light than this share of `far` are left out; without a limit a lamp's own glass
/// would take all of the depth resolution. Too large: the shadow of whatever hangs close under the lamp is
/// missing.
inline constexpr double smallestNearOverFar = 1e-3;

}  // namespace penumbra
