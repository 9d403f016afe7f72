#include "common/scene/light.h"

#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

constexpr double pi = 3.14159265358979323846;

double mean(const glm::dvec3& rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3.0;
}

/// Mean irradiance of one light at a typical distance: that to the middle of the scene, but at least a
/// quarter of the scene's radius (a lamp in the middle would otherwise count as infinitely bright), with the
/// lit side towards it.
double typicalIrradiance(const Scene& scene, const Light& light) {
    const double emission = mean(light.emission);
    if (light.type == LightType::directional) return emission;
    const double radius = scene.bounds.radius();
    const double distance = std::max(glm::length(scene.bounds.centre() - light.position), 0.25 * radius);
    const double intensity = light.type == LightType::area ? emission * light.area : emission;
    return distance > 0.0 ? intensity / (distance * distance) : intensity;
}

}  // namespace

glm::dvec3 directionToLight(const Light& light, const glm::dvec3& x) {
    if (light.type == LightType::directional) return -light.direction;
    const glm::dvec3 toLight = light.position - x;
    const double distance = glm::length(toLight);
    return distance > 0.0 ? toLight / distance : -light.direction;
}

double spotFactor(const Light& light, const glm::dvec3& toLight) {
    if (light.type != LightType::spot) return 1.0;
    const double inner = std::cos(light.innerCone), outer = std::cos(light.outerCone);
    const double along = glm::dot(-toLight, light.direction);
    if (!(inner > outer)) return along >= outer ? 1.0 : 0.0;
    const double ramp = std::clamp((along - outer) / (inner - outer), 0.0, 1.0);
    return ramp * ramp;
}

glm::dvec3 facingIrradiance(const Light& light, const glm::dvec3& x) {
    if (light.type == LightType::directional) return light.emission;
    const glm::dvec3 difference = light.position - x;
    const double distanceSquared = glm::dot(difference, difference);
    if (!(distanceSquared > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 toLight = directionToLight(light, x);
    if (light.type == LightType::area) {
        const double cosine = std::max(glm::dot(-toLight, light.direction), 0.0);
        return light.emission * (light.area * cosine / distanceSquared);
    }
    return light.emission * (spotFactor(light, toLight) / distanceSquared);
}

double keyIrradiance(const Scene& scene, int index) {
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (index < 0 || std::size_t(index) == i) sum += typicalIrradiance(scene, scene.lights[i]);
    }
    return std::isfinite(sum) && sum > 0.0 ? sum : 1.0;
}

float exposure(const Scene& scene, int index) {
    return float(pi / keyIrradiance(scene, index));
}

glm::vec3 ambientRadiance(const Scene& scene, int index, double fraction) {
    return glm::vec3(float(fraction * keyIrradiance(scene, index) / pi));
}

}  // namespace penumbra
