#include "common/scene/scene_defaults.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

void addFittedCamera(Scene& scene) {
    if (!scene.cameras.empty()) return;
    Camera camera;
    camera.name = "fitted view";
    // 1.05: a margin; the floor: a scene that is a single point still has a view.
    const double radius = std::max(1.05 * scene.bounds.radius(), 1e-6);
    const double distance = radius / std::sin(0.5 * camera.verticalFov);
    camera.forward = glm::normalize(glm::dvec3(-0.45, -0.4, -1.0));
    camera.up = glm::normalize(glm::dvec3(0, 1, 0) - camera.forward * camera.forward.y);
    camera.position = scene.bounds.centre() - distance * camera.forward;
    camera.near = distance - radius;
    camera.far = distance + radius;
    scene.cameras.push_back(camera);
    scene.notes.emplace_back("no camera: a view of everything was added");
}

void addSun(Scene& scene) {
    if (!scene.lights.empty()) return;
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    sun.direction = glm::normalize(glm::dvec3(0.5, -1.0, -0.35));
    sun.emission = glm::dvec3(3.14159265358979323846);
    scene.lights.push_back(sun);
    scene.notes.emplace_back("no light: a sun was added");
}

}  // namespace penumbra
