// Chapters 10 and 11: a convex body alone sees all of its sky; A is a share, and B a direction.
#include <fmt/format.h>

#include <cmath>

#include "tests/stress/any_scene.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/placement.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

/// A tetrahedron that the camera looks at; of a metre.
Scene convexBody(const Case& given) {
    Dice dice(std::uint64_t(given.integer("variant")));
    const glm::dvec3 eye(0.3, 0.5, 2.5);
    const Placement placement(given, eye, dice);
    const double stretch = given.integer("variant") > 0 ? dice.magnitude(1e-2, 1.0) : 1.0;
    const glm::dvec3 a(0.7, -0.5, 0.6), b(-0.8, -0.4, 0.5), c(0.1, 0.8 * stretch, 0.1), d(0.0, -0.3, -0.8);
    Scene scene = drawnScene(placement.triangles({{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}}));
    scene.lights.push_back(lightOf(given, placement, {0, 0, 0}, {0, 1, 0}, 3.0, 0.5));
    scene.cameras.push_back(cameraOf(placement, eye, {0, 0, 0}, 0.8));
    scene.cameras[0].near = placement.length(0.5);
    scene.cameras[0].far = placement.length(10.0);
    return scene;
}

/// Metres of the body behind pixel (x, y), in its middle. Where that is nothing, the camera's own depth
/// buffer decides which side of the body is seen.
double thickness(const Scene& scene, int x, int y, int size) {
    const Ray ray = cameraRay(scene.cameras[0], {x + 0.5, y + 0.5}, glm::ivec2(size));
    double first = 1e300, last = 0.0;
    for (const Triangle& t : trianglesIn(scene)) {
        const glm::dvec3 a = t[0] - ray.origin, b = t[1] - ray.origin, c = t[2] - ray.origin,
                         d = ray.direction;
        const double u = glm::dot(d, glm::cross(b, c)), v = glm::dot(d, glm::cross(c, a)),
                     w = glm::dot(d, glm::cross(a, b)), sum = u + v + w;
        if (sum == 0.0 || u * sum < 0.0 || v * sum < 0.0 || w * sum < 0.0) continue;
        const double hit = glm::length(u * a + v * b + w * c) / std::abs(sum);
        first = std::min(first, hit), last = std::max(last, hit);
    }
    return last - first;
}

Verdict checkConvex(const Case& given) {
    Verdict verdict;
    ChapterHarness& harness = shown("10", "convex", convexBody(given));
    const std::string format = given.choice("depth-format");
    harness.set("samples", std::to_string(std::min(given.integer("samples"), 64)));
    harness.set("map-size", std::to_string(given.integer("map-size")));
    harness.set("depth-format", format == "32f-reversed" ? "32f" : format);
    const FloatImage A = harness.scalar("ambient", glm::ivec2(given.integer("picture")));
    const std::string found = notFinite(A);
    if (!found.empty()) verdict.fail(found);
    const double least = 0.01 * given.number("scale") + 0x1p-20 * glm::length(harness.scene.bounds.upper);
    for (int y = 0; y < A.height; ++y) {
        for (int x = 0; x < A.width; ++x) {
            const double value = A.at(x, y);
            verdict.expectAtMost("A above 1", value - 1.0, 1e-5);
            if (value == 0.0 || !(thickness(harness.scene, x, y, A.width) > least)) continue;
            if (promised(given)) verdict.expectAtMost("sky lost to the body itself", 1.0 - value, 0.01);
            verdict.measure("sky lost, however far aside", 1.0 - value);
        }
    }
    return verdict;
}

Verdict checkBent(const Case& drawn) {
    Verdict verdict;
    Case given = drawn;
    const bool eleven = given.integer("variant") % 2 == 1;
    given.values["chapter"] = axisNamed("chapter").parse(eleven ? "11" : "10");
    ChapterHarness& harness = shown(eleven ? "11" : "10", "bent", anyScene(given));
    harness.set(settingsOf(given));
    harness.set("samples", std::to_string(std::clamp(given.integer("samples"), 4, 64)));
    if (eleven) harness.set("source", given.integer("variant") % 4 == 1 ? "maps" : "rays");
    const glm::ivec2 size(given.integer("picture"));
    const FloatImage A = harness.scalar("ambient", size), B = harness.picture("bent-normal", size, 3);
    for (const FloatImage* image : {&A, &B})
        if (const std::string found = notFinite(*image); !found.empty()) verdict.fail(found);
    for (std::size_t i = 0; i < A.values.size(); ++i) {
        const double a = A.values[i];
        verdict.expectAtMost("A above 1", a - 1.0, 1e-5);
        verdict.expectAtMost("A below 0", -a, 0.0);
        // The view shows directions, as 1/2 + B/2; black where there is no surface.
        const glm::dvec3 shown(B.values[3 * i], B.values[3 * i + 1], B.values[3 * i + 2]);
        if (shown != glm::dvec3(0.0))
            verdict.expectAtMost("length of a direction, off 1",
                                 std::abs(glm::length(2.0 * shown - 1.0) - 1.0), 1e-5);
    }
    return verdict;
}

const AddSubject convex({.name = "sky-maps",
                         .claim = "10: a convex body alone takes no sky from itself but what grazes it",
                         .axes = {"depth-format", "scale", "distance", "aside", "map-size", "picture",
                                  "samples", "variant"},
                         .check = checkConvex,
                         .share = 1.0});
const AddSubject bent(
    {.name = "bent-vectors",
     .claim = "10 and 11: A lies in [0,1], and B is a direction wherever there is a surface",
     .axes = {"light-type", "shape", "light-angle", "scale", "distance", "aside", "fov", "map-size",
              "picture", "samples", "variant"},
     .check = checkBent,
     .share = 0.1});

}  // namespace
}  // namespace penumbra::stress
