#include "chapters/08_accumulation/plane_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/scene/light.h"
#include "common/truth/lambert_polygon.h"
#include "common/truth/polygon_light.h"
#include "common/truth/segment_test.h"

namespace penumbra {

namespace {

/// Metres: the farthest that the receiver's numbers go.
double extent(const Receiver& receiver) {
    return glm::length(receiver.corner) + glm::length(receiver.uEdge) + glm::length(receiver.vEdge);
}

}  // namespace

PlaneLight::PlaneLight(const Receiver& receiver, const Light& light) : n_(receiver.normal), light_(light) {
    unit_.direction = light.direction;
    unit_.position = light.position;
    unit_.type = light.type;
    unit_.innerCone = light.innerCone;
    unit_.outerCone = light.outerCone;
    plainly_ = 1e-9 * (glm::length(light.position) + std::sqrt(light.area) + extent(receiver));
    for (const auto& polygon : light.polygons)
        for (const glm::dvec3& p : polygon) isAbove_ = isAbove_ && receiver.height(p) > plainly_;
}

double PlaneLight::unoccluded(const glm::dvec3& x) const {
    if (light_.type != LightType::area) return fromPoint(x);
    double sum = 0.0;
    for (const auto& polygon : light_.polygons) sum += whole(x, polygon);
    return std::numbers::pi * sum;
}

double PlaneLight::visible(const glm::dvec3& x, std::span<const Triangle> occluders) const {
    if (light_.type != LightType::area) return seen(x, occluders) ? fromPoint(x) : 0.0;
    double sum = 0.0;
    for (const auto& polygon : light_.polygons) sum += visibleFormFactor(x, n_, polygon, occluders);
    return std::numbers::pi * sum;
}

/// formFactor to the bit, three times as fast where `x` is plainly in front of the light, the light plainly
/// above the receiver and plainly not wide, so that nothing of it has to be cut.
double PlaneLight::whole(const glm::dvec3& x, const std::vector<glm::dvec3>& polygon) const {
    if (!isAbove_ || polygon.size() > cornersOfALight) return formFactor(x, n_, polygon);
    const double height = glm::dot(light_.direction, x - polygon[0]);
    const double widest = 0.99 * heightsOfAWideLight * height;
    Polygon3 relative;
    bool plain = height >= plainly_;
    for (const glm::dvec3& p : polygon) {
        relative.push(p - x);
        plain = plain && glm::dot(p - x, p - x) <= widest * widest;
    }
    return plain ? lambertFormFactor(n_, relative) : formFactor(x, n_, polygon);
}

double PlaneLight::fromPoint(const glm::dvec3& x) const {
    return facingIrradiance(unit_, x).x * std::max(0.0, glm::dot(n_, directionToLight(unit_, x)));
}

bool PlaneLight::seen(const glm::dvec3& x, std::span<const Triangle> occluders) const {
    const bool far = light_.type == LightType::directional;
    const Segment toLight = {x, far ? -light_.direction : light_.position, far};
    return std::none_of(occluders.begin(), occluders.end(),
                        [&](const Triangle& t) { return crossTriangle(toLight, t) == Crossing::inside; });
}

}  // namespace penumbra
