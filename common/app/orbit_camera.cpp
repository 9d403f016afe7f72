#include "common/app/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace penumbra {
namespace {

constexpr double steepest = 1.55;  // radians from the horizon; a quarter turn is 1.5708
const glm::dvec3 vertical{0.0, 1.0, 0.0};

glm::dvec3 targetOf(const Camera& camera, const Aabb& scene) {
    const double radius = scene.empty() ? 1.0 : std::max(scene.radius(), 1e-6);
    const glm::dvec3 centre = scene.empty() ? camera.position : scene.centre();
    const double along = glm::dot(centre - camera.position, camera.forward);
    return camera.position + camera.forward * std::max(along, 0.1 * radius);
}

}  // namespace

OrbitCamera::OrbitCamera(const Camera& start, const Aabb& scene)
    : start_(start),
      startTarget_(targetOf(start, scene)),
      camera_(start),
      target_(startTarget_),
      sceneRadius_(scene.radius()) {}

double OrbitCamera::distance() const {
    return glm::length(camera_.position - target_);
}

void OrbitCamera::orbit(double yaw, double pitch) {
    const double elevation = std::asin(std::clamp(camera_.forward.y, -1.0, 1.0));
    const double limit =
        std::max(steepest, std::abs(elevation));  // a camera that starts steeper may stay there
    const double turn = std::clamp(elevation - pitch, -limit, limit) - elevation;
    const glm::dvec3 right = glm::normalize(glm::cross(camera_.forward, camera_.up));
    const glm::dquat rotation = glm::angleAxis(-yaw, vertical) * glm::angleAxis(turn, right);
    camera_.forward = glm::normalize(rotation * camera_.forward);
    camera_.up = rotation * camera_.up;
    camera_.up = glm::normalize(camera_.up - camera_.forward * glm::dot(camera_.up, camera_.forward));
    camera_.position = target_ - camera_.forward * distance();
}

void OrbitCamera::zoom(double factor) {
    if (camera_.orthographic) {
        camera_.height *= factor;
        return;
    }
    const double startDistance = glm::length(start_.position - startTarget_);
    const double wanted = std::clamp(distance() * factor, 1e-3 * startDistance, 1e3 * startDistance);
    camera_.position = target_ - camera_.forward * wanted;
    camera_.near = start_.near * std::min(1.0, wanted / startDistance);
    camera_.far = std::max(start_.far, wanted + 2.0 * sceneRadius_);
}

void OrbitCamera::pan(double right, double up) {
    const double height =
        camera_.orthographic ? camera_.height : 2.0 * std::tan(0.5 * camera_.verticalFov) * distance();
    const glm::dvec3 shift =
        height * (right * glm::normalize(glm::cross(camera_.forward, camera_.up)) + up * camera_.up);
    camera_.position -= shift;
    target_ -= shift;
}

void OrbitCamera::reset() {
    camera_ = start_;
    target_ = startTarget_;
}

}  // namespace penumbra
