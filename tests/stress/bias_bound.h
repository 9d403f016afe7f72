// Chapter 03's bias B = S + Q + C as its shader may have it, in double, from above.
#pragma once

#include <glm/glm.hpp>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "chapters/01_depth_from_light/light_frustum.h"

namespace penumbra::stress {

/// What a filter asks for beyond chapter 03 (receiver.glsl, kernelBias).
struct TapReach {
    bool followsPlane = false;
    double square = 0.0;  ///< texels along both axes up to which taps lie
    double disk = 0.0;    ///< the same of a disk
    double footprint =
        0.0;  ///< texels between a tap and the centre that it is compared at, beyond chapter 03
};

/// At one point of a plane. A shader knows the plane's slope from the differences between neighbouring
/// pixels, and bounds what rounding leaves unsure of it; so the bias lies between what the exact slope asks
/// for and this. Beyond 85 degrees it ends (steepestSlope), and may be less than the exact slope asks for.
class BiasBound {
 public:
    /// `strq` of the point, and its exact differences `dx` and `dy` between neighbouring pixels. `errors`: of
    /// both passes.
    BiasBound(const LightFrustum& frustum, const DepthErrors& errors, int mapSize, const glm::dvec4& strq,
              const glm::dvec4& dx, const glm::dvec4& dy);

    /// Window depth.
    double bias(const TapReach& reach = {}) const;
    /// What chapter 03 asks for where the slope (over the whole map) is known exactly, however steep: what
    /// the depth of a texel and that of the surface in it may differ by.
    double asked(const glm::dvec2& slope) const;
    /// dz/ds and dz/dt over the whole map.
    const glm::dvec2& slope() const { return slope_; }
    /// What s, t may be off by, in texels.
    double sideways() const;

 private:
    double withSlope(double atMost, const TapReach& reach) const;

    DepthErrors errors_;
    glm::dvec3 rounding_;
    double mapSize_, perQ_, z_, atMost_;
    glm::dvec2 slope_;
};

}  // namespace penumbra::stress
