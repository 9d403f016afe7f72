// How much of a light a surface sees, as the truth pictures ask: visibility in [0,1], and no energy made.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/polygon.h"
#include "common/truth/light_visibility.h"
#include "common/truth/polygon_light.h"
#include "common/truth/surface_hit.h"
#include "tests/stress/area_light_scene.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Light areaLight(const std::vector<glm::dvec3>& corners, Dice& dice) {
    Light light;
    light.type = LightType::area;
    light.polygons = {corners};
    light.direction = glm::normalize(areaNormal(corners));
    light.area = 0.5 * glm::length(areaNormal(corners));
    light.position = glm::dvec3(0.0);
    for (const glm::dvec3& p : corners) light.position += p / double(corners.size());
    light.emission = glm::dvec3(dice.magnitude(1e-6, 1e6));
    return light;
}

void ask(Verdict& verdict, const LightVisibility& visibility, const Light& light, const Hit& hit,
         bool asPoint) {
    const LightAnswer answer = visibility.at(hit, 5);
    const double brightest = std::max({answer.irradiance.x, answer.irradiance.y, answer.irradiance.z});
    verdict.expectAtMost("visibility beyond 1", answer.visible - 1.0, 0.0);
    verdict.expectAtMost("visibility below 0", -answer.visible, 0.0);
    verdict.expectAtMost("not a number",
                         std::isfinite(brightest) && std::isfinite(answer.visible) ? 0.0 : 1.0, 0.0);
    if (asPoint) return;
    const double unshadowed =
        light.emission.x * std::numbers::pi * formFactor(hit.position, hit.shadingNormal, light.polygons[0]);
    // Cut at the surface, the polygon has other corners, and may be larger by their rounding.
    const AreaLightScene alone{hit.position, hit.shadingNormal, light.polygons[0], {}};
    const double bound = 1e-14 + sweptBy(alone, 16.0 * epsilon * largestMagnitude(alone));
    if (bound < 0.1)
        verdict.expectAtMost("energy made, over the rounding of the light's corners",
                             (brightest - unshadowed) / (std::numbers::pi * light.emission.x) / bound, 1.0);
    verdict.expectAtMost("light without visibility", !answer.facing && brightest > 0.0 ? 1.0 : 0.0, 0.0);
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(77u + std::uint64_t(given.integer("variant")));
    AreaLightScene drawn = areaLightScene(given);
    // Floor under the receiver, and whatever hangs over it.
    drawn.occluders.push_back({glm::dvec3(-0.7, -0.4, 0.0), {0.9, -0.5, 0.0}, {0.1, 0.8, 0.0}});
    drawn = moved(drawn, glm::dmat3(1.0), given.number("scale"),
                  given.number("distance") / std::sqrt(3.0) * glm::dvec3(1.0));
    const Scene scene = sceneOf(drawn.occluders);
    const RayTracer tracer(scene);
    const ExactScene exact(scene);
    const Light light = areaLight(drawn.light, dice);
    if (!std::isfinite(light.direction.x)) return verdict;  // so far away that its corners have become one
    const LightVisibility area(exact, tracer, light, false), point(exact, tracer, light, true);
    for (int i = 0; i < 8; ++i) {
        const auto triangle = std::uint32_t(i < 3 ? drawn.occluders.size() - 1
                                                  : std::size_t(dice.below(int(drawn.occluders.size()))));
        const double u = dice.unit();
        Hit hit = surfaceHit(scene, triangle, {u, (1.0 - u) * dice.unit()});
        if (dice.oneIn(3)) hit.shadingNormal = glm::normalize(hit.geometricNormal + 0.7 * dice.direction());
        ask(verdict, area, light, hit, false);
        ask(verdict, point, light, hit, true);
    }
    return verdict;
}

const AddSubject lightVisibility(
    {.name = "light-visibility",
     .claim = "what a surface sees of a light is in [0,1], and shadows make no light",
     .axes = {"shape", "light-angle", "light-size", "scale", "distance", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
