#include "tests/stress/placement.h"

#include <cmath>

#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {

Placement::Placement(const Case& given, const glm::dvec3& eye, Dice& dice) : scale_(given.number("scale")) {
    if (given.integer("variant") > 0) {
        const glm::dvec3 x = dice.direction(), y = dice.across(x);
        turn_ = {x, y, glm::cross(x, y)};
    }
    offset_ = glm::dvec3(given.number("distance") / std::sqrt(3.0));
    origin_ = inFile(eye + glm::dvec3(given.number("aside") / std::sqrt(3.0)));
}

glm::dvec3 Placement::point(const glm::dvec3& p) const {
    return inFile(p) - origin_;
}

std::vector<Triangle> Placement::triangles(std::vector<Triangle> local) const {
    for (Triangle& triangle : local)
        for (glm::dvec3& p : triangle) p = point(p);
    return local;
}

double Placement::rounding(const Scene& scene) const {
    const glm::dvec3 here = glm::max(glm::abs(scene.bounds.lower), glm::abs(scene.bounds.upper));
    const glm::dvec3 there = glm::abs(offset_) + glm::abs(origin_);
    return 0x1p-24 * glm::length(here) + 0x1p-52 * glm::length(there);
}

Scene drawnScene(const std::vector<Triangle>& triangles) {
    Scene scene = sceneOf(triangles);
    scene.materials[0].doubleSided = true;
    scene.clusters.push_back({0, std::uint32_t(triangles.size()), 0, scene.bounds});
    scene.lights.clear();
    scene.cameras.clear();
    return scene;
}

Camera cameraOf(const Placement& placement, const glm::dvec3& eye, const glm::dvec3& target, double fov) {
    Camera camera;
    camera.position = placement.point(eye);
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 beside = std::abs(forward.y) > 0.9 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    camera.forward = placement.direction(forward);
    camera.up = placement.direction(glm::normalize(beside - forward * glm::dot(beside, forward)));
    camera.verticalFov = fov;
    camera.near = placement.length(1e-3);
    camera.far = placement.length(1e3);
    return camera;
}

Light lightOf(const Case& given, const Placement& placement, const glm::dvec3& target,
              const glm::dvec3& toLight, double distance, double halfAngle) {
    Light light;
    const std::string type = given.values.contains("light-type") ? given.choice("light-type") : "directional";
    light.type = type == "spot"    ? LightType::spot
                 : type == "point" ? LightType::point
                                   : LightType::directional;
    light.position = placement.point(target + distance * toLight);
    light.direction = placement.direction(-toLight);
    light.outerCone = halfAngle;
    // As bright at the target, however large everything is.
    if (light.type != LightType::directional) light.emission *= std::pow(placement.length(distance), 2.0);
    return light;
}

}  // namespace penumbra::stress
