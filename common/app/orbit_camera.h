// A camera that is turned around the scene by hand.
#pragma once

#include "common/math/aabb.h"
#include "common/scene/scene.h"

namespace penumbra {

/// Starts as a camera of the scene, to the bit, and is that camera again after `reset`. Turns about the point
/// on its axis that is nearest to the centre of the scene.
class OrbitCamera {
 public:
    OrbitCamera(const Camera& start, const Aabb& scene);

    const Camera& camera() const { return camera_; }
    /// Radians, to the right about the vertical and upwards; stops short of looking straight up or down.
    void orbit(double yaw, double pitch);
    /// Multiplies the distance (orthographic: the height of the view); the far plane follows, so that nothing
    /// is cut off.
    void zoom(double factor);
    /// Shifts the picture, in heights of the view, right and up.
    void pan(double right, double up);
    void reset();

 private:
    double distance() const;

    Camera start_;
    glm::dvec3 startTarget_;
    Camera camera_;
    glm::dvec3 target_;
    double sceneRadius_;
};

}  // namespace penumbra
