// The closed forms of area lights: Lambert's formula, its clipping at the horizon, and cone subtraction.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/math/hemisphere.h"
#include "common/truth/exact_scene.h"
#include "common/truth/light_pyramid.h"
#include "common/truth/polygon_light.h"
#include "common/truth/segment_test.h"
#include "tests/stress/area_light_scene.h"
#include "tests/stress/triangle_soup.h"
#include "tests/unit/polygon_light_reference.h"

namespace penumbra::stress {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// What polygon_light.h promises for parts that together are the whole.
constexpr double crack = 1e-14;

double visible(const AreaLightScene& scene) {
    return visibleFormFactor(scene.x, scene.normal, scene.light, scene.occluders);
}

/// Metres that a position can be off as far as the code may take it: its own rounding, and the distance from
/// a plane at which it counts as in it (LightPyramid::rounding and appendCone).
double tolerated(const AreaLightScene& scene) {
    return 24.0 * epsilon * largestMagnitude(scene);
}

/// `difference` of two answers that rounding alone may set apart.
void compare(Verdict& verdict, const std::string& name, double difference, double bound) {
    if (bound < 0.1) verdict.expectAtMost(name + ", over the bound", std::abs(difference) / bound, 1.0);
}

/// Between nothing and all, and a form factor.
void inRange(Verdict& verdict, const AreaLightScene& scene) {
    const double whole = formFactor(scene.x, scene.normal, scene.light), seen = visible(scene);
    verdict.expectAtMost("form factor", whole, 1.0 + 4.0 * epsilon);
    verdict.expectAtMost("form factor below 0", -std::min(whole, seen), 0.0);
    verdict.expectAtMost("seen of the light, beyond all of it", seen - whole, 0.0);
    verdict.expectAtMost("not a number", std::isfinite(seen) && std::isfinite(whole) ? 0.0 : 1.0, 0.0);
}

/// The parts of the light are the light, and the parts of the occluders are the occluders.
void inParts(Verdict& verdict, const AreaLightScene& scene, Dice& dice) {
    const double error = tolerated(scene);
    if (onTheEdge(scene, 64.0 * error)) return;
    const double whole = visible(scene), bound = crack + sweptBy(scene, error);
    AreaLightScene parts = scene;
    parts.occluders = cutInThree(scene.occluders, dice);
    compare(verdict, "occluders cut in three", visible(parts) - whole, bound);
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : scene.light) middle += p / double(scene.light.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.light.size(); ++i) {
        const std::array part = {scene.light[i], scene.light[(i + 1) % scene.light.size()], middle};
        sum += visibleFormFactor(scene.x, scene.normal, part, scene.occluders);
    }
    compare(verdict, "light cut in wedges", sum - whole, bound);
}

/// Of the segment from x to `target`: how near to an edge of an occluder it passes, as an angle, or ends near
/// its plane, as a part of its length.
double narrowest(const AreaLightScene& scene, const glm::dvec3& target) {
    const glm::dvec3 d = target - scene.x;
    double least = 1.0;
    for (const Triangle& t : scene.occluders) {
        const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
        const double scale = glm::length(normal) * glm::length(d);
        least = std::min(least, scale > 0.0 ? std::abs(glm::dot(normal, target - t[0])) / scale : 0.0);
        least = std::min(least, scale > 0.0 ? std::abs(glm::dot(normal, scene.x - t[0])) / scale : 0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 plane = edgePlane(t[i] - scene.x, t[(i + 1) % 3] - scene.x);
            const double size = glm::length(plane) * glm::length(d);
            least = std::min(least, size > 0.0 ? std::abs(glm::dot(plane, d)) / size : 0.0);
        }
    }
    return least;
}

/// A part of the light that is wholly seen is seen in its middle, and one that is not is not.
void asRaysSeeIt(Verdict& verdict, const AreaLightScene& scene) {
    if (onTheEdge(scene, 64.0 * tolerated(scene))) return;
    constexpr int cells = 4;
    const std::size_t wedges = std::min<std::size_t>(scene.light.size() - 2, 3);
    for (std::size_t wedge = 0; wedge < wedges; ++wedge) {
        const glm::dvec3 &a = scene.light[0], &b = scene.light[wedge + 1], &c = scene.light[wedge + 2];
        const auto at = [&](double u, double v) { return a + u / cells * (b - a) + v / cells * (c - a); };
        for (int i = 0; i < cells; ++i)
            for (int j = 0; i + j < cells; ++j) {
                const std::array part = {at(i, j), at(i + 1, j), at(i, j + 1)};
                const glm::dvec3 middle = at(i + 1.0 / 3.0, j + 1.0 / 3.0);
                const double whole = formFactor(scene.x, scene.normal, part);
                if (!(whole > 0.0) || glm::dot(scene.normal, middle - scene.x) <= 0.0) continue;
                const double seen = visibleFormFactor(scene.x, scene.normal, part, scene.occluders);
                if (seen != whole && seen != 0.0) continue;
                const bool blocked = std::ranges::any_of(scene.occluders, [&](const Triangle& t) {
                    return crossTriangle({scene.x, middle}, t) == Crossing::inside;
                });
                if (blocked != (seen == 0.0))
                    verdict.expectAtMost("seen otherwise by a ray, though it passes so far from every edge",
                                         narrowest(scene, middle), 64.0 * epsilon);
            }
    }
}

/// A surface does not shadow the points on it, to the bit, wherever it is.
void onASurface(Verdict& verdict, const AreaLightScene& scene, Dice& dice) {
    const double size = glm::distance(scene.light[0], scene.x);
    const glm::dvec3 u = size * dice.direction(), v = size * dice.direction();
    const auto at = [&](double s, double t) { return scene.x + s * u + t * v; };
    AreaLightScene more = scene;
    more.occluders.push_back(
        {at(-dice.unit(), -dice.unit()), at(dice.unit(), -dice.unit()), at(0.1, dice.unit())});
    verdict.expectAtMost("shadow of the surface it lies on", std::abs(visible(more) - visible(scene)), 0.0);
}

/// Turned, scaled and far away it is the same, as well as doubles know where it is.
void anywhere(Verdict& verdict, const Case& given, const AreaLightScene& scene, Dice& dice) {
    const double scale = given.number("scale");
    const AreaLightScene doubled =
        moved(scene, glm::dmat3(1.0), std::exp2(std::round(std::log2(scale))), glm::dvec3(0.0));
    verdict.expectAtMost("scaled by a power of two, difference", std::abs(visible(doubled) - visible(scene)),
                         0.0);
    const AreaLightScene far = moved(scene, frameAround(dice.direction()), scale,
                                     given.number("distance") / std::sqrt(3.0) * glm::dvec3(1.0));
    inRange(verdict, far);
    onASurface(verdict, far, dice);
    const double error = tolerated(far);
    if (onTheEdge(far, 64.0 * error) || onTheEdge(scene, 64.0 * error / scale)) return;
    compare(verdict, "turned, scaled and moved", visible(far) - visible(scene),
            crack + sweptBy(far, error) + 16.0 * epsilon);
}

/// Lambert's formula against a quadrature where the light is small, and against 64 bits where it is not.
void asAccurateAsPromised(Verdict& verdict, const Case& given, const AreaLightScene& scene, Dice& dice) {
    constexpr double grid = 0x1p44;  // sums and differences of corners are exact: a true parallelogram
    const double size = given.number("light-size");
    const auto snap = [&](const glm::dvec3& p) { return glm::round(p * grid) / grid; };
    const glm::dvec3 normal = -glm::normalize(scene.light[0]);
    const glm::dvec3 side = dice.across(normal);
    const glm::dvec3 u = snap(size * side), v = snap(size * glm::cross(normal, side));
    const glm::dvec3 corner = snap(scene.light[0] - 0.5 * (u + v));
    const std::array light = {corner, corner + u, corner + u + v, corner + v};
    const Polygon3 above =
        clip(Polygon3(light), [&](const glm::dvec3& p) { return glm::dot(scene.normal, p); });
    double grazing = 1.0;
    for (const glm::dvec3& p : light) grazing = std::min(grazing, glm::dot(scene.normal, p) / glm::length(p));
    if (grazing <= 0.0) {
        verdict.expectAtMost("error of a light that the horizon cuts",
                             std::abs(formFactor(glm::dvec3(0.0), scene.normal, light) -
                                      longDoubleFormFactor(scene.normal, above.span())),
                             1e-14);
        return;
    }
    const double exact =
        size < 0.01 ? gaussFormFactor(scene.normal, light) : longDoubleFormFactor(scene.normal, light);
    verdict.expectAtMost("relative error of Lambert's formula",
                         std::abs(formFactor(glm::dvec3(0.0), scene.normal, light) - exact) / exact /
                             (1.0 + 2.0 * epsilon / (1e-14 * grazing)),
                         1e-14);
}

Verdict check(const Case& given) {
    Verdict verdict;
    const AreaLightScene scene = areaLightScene(given);
    Dice dice(0x9e3779b9u + std::uint64_t(given.integer("variant")));
    inRange(verdict, scene);
    inParts(verdict, scene, dice);
    asRaysSeeIt(verdict, scene);
    anywhere(verdict, given, scene, dice);
    asAccurateAsPromised(verdict, given, scene, dice);
    AreaLightScene rounded = scene;
    const Scene floats = sceneOf(scene.occluders);
    rounded.occluders = trianglesIn(floats);
    verdict.expectAtMost(
        "the hierarchy's difference",
        std::abs(ExactScene(floats).visibleFormFactor(rounded.x, rounded.normal, rounded.light) -
                 visible(rounded)),
        0.0);
    return verdict;
}

const AddSubject areaLight(
    {.name = "area-light",
     .claim = "closed forms of area lights: in range, the same in parts, anywhere, at any "
              "scale, and as rays see them",
     .axes = {"shape", "light-angle", "light-size", "scale", "distance", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
