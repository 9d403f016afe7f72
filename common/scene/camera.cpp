#include "common/scene/camera.h"

#include <cmath>

namespace penumbra {

glm::dmat4 viewFromWorld(const Camera& camera) {
    return viewFromWorld(camera.position, camera.forward, camera.up);
}

glm::dmat4 clipFromView(const Camera& camera, double aspect, DepthRange range) {
    if (!camera.orthographic) return perspective(camera.verticalFov, aspect, camera.near, camera.far, range);
    const double y = 0.5 * camera.height, x = y * aspect;
    return orthographic(-x, x, -y, y, camera.near, camera.far, range);
}

glm::dmat4 clipFromWorld(const Camera& camera, double aspect) {
    return clipFromView(camera, aspect) * viewFromWorld(camera);
}

Ray cameraRay(const Camera& camera, const glm::dvec2& pixel, const glm::ivec2& size) {
    const glm::dvec2 resolution(size);
    const double ndcX = 2.0 * pixel.x / resolution.x - 1.0;
    const double ndcY = 1.0 - 2.0 * pixel.y / resolution.y;
    const double halfHeight = camera.orthographic ? 0.5 * camera.height : std::tan(0.5 * camera.verticalFov);
    const glm::dvec3 right = glm::cross(camera.forward, camera.up);
    const glm::dvec3 offset = halfHeight * (ndcX * (resolution.x / resolution.y) * right + ndcY * camera.up);
    if (camera.orthographic) return {camera.position + offset, camera.forward};
    return {camera.position, camera.forward + offset};
}

}  // namespace penumbra
