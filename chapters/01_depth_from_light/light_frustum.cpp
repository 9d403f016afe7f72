#include "chapters/01_depth_from_light/light_frustum.h"

#include <cmath>

namespace penumbra {

// [begin:light-camera]
glm::dmat4 LightFrustum::clipFromWorld() const {
    const glm::dmat4 clipFromLightView =
        orthographic
            ? penumbra::orthographic(-halfExtent.x, halfExtent.x, -halfExtent.y, halfExtent.y, near, far,
                                     range)
            : perspective(2.0 * std::atan(halfExtent.y), halfExtent.x / halfExtent.y, near, far, range);
    return clipFromLightView * lightViewFromWorld;
}

glm::dmat4 LightFrustum::textureFromWorld() const {
    return textureFromClip(range) * clipFromWorld();
}
// [end:light-camera]

double LightFrustum::windowDepth(double z) const {
    const double share = orthographic ? (z - near) / (far - near) : (z - near) / (far - near) * far / z;
    return range == DepthRange::reversed ? 1.0 - share : share;
}

double LightFrustum::eyeDepth(double window) const {
    const double share = range == DepthRange::reversed ? 1.0 - window : window;
    return orthographic ? near + share * (far - near) : far * near / (far - share * (far - near));
}

glm::dvec2 LightFrustum::texelSize(double z, int mapSize) const {
    return 2.0 * halfExtent * (orthographic ? 1.0 : z) / double(mapSize);
}

Ray LightFrustum::ray(const glm::dvec2& uv) const {
    const glm::dmat3 worldFromLightView = glm::transpose(glm::dmat3(lightViewFromWorld));
    const glm::dvec2 lateral = (2.0 * uv - 1.0) * halfExtent;
    if (orthographic)
        return {eye + worldFromLightView * glm::dvec3(lateral, -near),
                worldFromLightView * glm::dvec3(0, 0, -1)};
    const glm::dvec3 direction = worldFromLightView * glm::dvec3(lateral, -1.0);
    return {eye + near * direction, direction};
}

double LightFrustum::axisDistance(const glm::dvec3& x) const {
    return -(lightViewFromWorld * glm::dvec4(x, 1.0)).z;
}

}  // namespace penumbra
