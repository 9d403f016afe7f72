#include "tests/stress/bias_bound.h"

#include <algorithm>
#include <cmath>

#include "chapters/03_polygon_offset/depth_bias.h"

namespace penumbra::stress {
namespace {

/// Of what arithmetic rounds away, the shader takes a multiple: 1 and 8 times what it finds r to be off,
/// which is no more than the bound itself.
constexpr double found = 9.0;

}  // namespace

BiasBound::BiasBound(const LightFrustum& frustum, const DepthErrors& errors, int mapSize,
                     const glm::dvec4& strq, const glm::dvec4& dx, const glm::dvec4& dy)
    : errors_(errors),
      rounding_(found * glm::dvec3(errors.rounding)),
      mapSize_(mapSize),
      perQ_(1.0 / strq.w),
      z_(strq.z / strq.w) {
    const glm::dvec3 str = glm::dvec3(strq) * perQ_;
    const glm::dvec3 a = glm::dvec3(dx) - str * dx.w, b = glm::dvec3(dy) - str * dy.w;
    const double volume = a.x * b.y - a.y * b.x;
    const glm::dvec2 volumes(a.z * b.y - a.y * b.z, a.x * b.z - a.z * b.x);
    slope_ = volumes / volume;
    // depth_slope.glsl allows `error` in each component, and components may be off by as much the other way.
    const double error = 2.0 * 16.0 * 0x1p-24 * std::abs(strq.w);
    const glm::dvec3 sizes = glm::abs(a) + glm::abs(b);
    const double surely = std::abs(volume) - error * (sizes.x + sizes.y);
    const double sum =
        std::abs(volumes.x) + std::abs(volumes.y) + error * (sizes.x + sizes.y + 2.0 * sizes.z);
    const double steepest = steepestSlope(frustum) * perQ_;
    atMost_ = sum < steepest * surely ? sum / surely : steepest;
}

double BiasBound::bias(const TapReach& reach) const {
    return withSlope(atMost_, reach);
}

double BiasBound::asked(const glm::dvec2& slope) const {
    return withSlope(std::abs(slope.x) + std::abs(slope.y), {});
}

double BiasBound::withSlope(double atMost, const TapReach& reach) const {
    const glm::dvec2 slope = glm::abs(slope_);
    // The shader's slope is off by as much as its bound is above the exact one, both ways.
    const double unsure = std::min(atMost, 2.0 * std::max(atMost - slope.x - slope.y, 0.0));
    const double lateral = (rounding_.x + rounding_.z) * perQ_ * atMost;
    const double S = reach.followsPlane ? 0.5 / mapSize_ * (unsure + 2.0 * errors_.snap * atMost)
                                        : (0.5 + errors_.snap) / mapSize_ * atMost;
    const double follows = reach.followsPlane ? 0.0 : 1.0;
    const double beside = reach.square * (unsure + follows * std::min(atMost, slope.x + slope.y + unsure)) +
                          reach.disk * (unsure + follows * std::min(atMost, glm::length(slope) + unsure)) +
                          reach.footprint * atMost;
    const double Q = errors_.quantum.x + errors_.quantum.y * std::abs(z_);
    const double C = (rounding_.y + std::abs(z_) * rounding_.z) * perQ_ + errors_.rasterError.x +
                     errors_.rasterError.y * (std::abs(z_) + atMost);
    return S + lateral + beside / mapSize_ + Q + C;
}

double BiasBound::sideways() const {
    return mapSize_ * (rounding_.x + rounding_.z) * perQ_ + 0x1p-22 * mapSize_;
}

}  // namespace penumbra::stress
