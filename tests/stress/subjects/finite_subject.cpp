// No picture of any chapter holds a value that is no number, whatever the scene.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/image/lit_scenes.h"
#include "tests/stress/chapters.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/placement.h"
#include "tests/stress/triangle_shapes.h"

namespace penumbra::stress {
namespace {

constexpr double degrees = std::numbers::pi / 180.0;

/// A ground of two triangles, and some of the shape above and in it.
Scene anyScene(const Case& given) {
    Dice dice(std::uint64_t(given.integer("variant")));
    const glm::dvec3 eye(0.4, 1.5, 2.2);
    const Placement placement(given, eye, dice);
    std::vector<Triangle> triangles{{glm::dvec3(-2, 0, 2), glm::dvec3(2, 0, 2), glm::dvec3(2, 0, -2)},
                                    {glm::dvec3(-2, 0, 2), glm::dvec3(2, 0, -2), glm::dvec3(-2, 0, -2)}};
    const TrianglePlace place{{0.1, 0.4, -0.1}, 0.8, {0, 1, 0}};
    for (const Triangle& t : trianglesOf(given.choice("shape"), place, dice)) triangles.push_back(t);
    Scene scene = drawnScene(placement.triangles(std::move(triangles)));
    const double angle = given.number("light-angle") * degrees;
    const glm::dvec3 toLight(std::sin(angle), std::cos(angle), 0.0);
    scene.lights.push_back(lightOf(given, placement, {0, 0, 0}, toLight, 3.0, 0.6));
    scene.cameras.push_back(cameraOf(placement, eye, {0, 0, 0}, given.number("fov") * degrees));
    if (given.choice("chapter") != "08") return scene;
    const std::vector<glm::dvec3> local =
        squareLight(3.0 * toLight, -toLight, 3.0 * std::min(given.number("light-size"), 10.0));
    std::vector<glm::dvec3> corners;
    for (const glm::dvec3& p : local) corners.push_back(placement.point(p));
    scene.lights.clear();
    return withAreaLight(std::move(scene), corners);
}

Settings settingsOf(const Case& given) {
    const std::string chapter = given.choice("chapter");
    const std::string size = std::to_string(given.integer("map-size"));
    if (chapter == "08")
        return {{"samples", "16"}, {"others-samples", "2"}, {"map-size", size}, {"texel-budget", "4"}};
    if (chapter == "10") return {{"samples", "8"}, {"map-size", size}};
    if (chapter == "11") return {{"samples", "8"}, {"source", "maps"}, {"map-size", size}};
    Settings settings{{"map-size", size}, {"depth-format", given.choice("depth-format")}};
    if (chapter == "06" || chapter == "07") settings.emplace_back("samples", "8");
    if (chapter >= "05") settings.emplace_back("radius", fmt::format("{}", given.number("radius")));
    return settings;
}

Verdict check(const Case& given) {
    Verdict verdict;
    const std::string chapter = given.choice("chapter");
    ChapterHarness& harness = shown(chapter, "", anyScene(given));
    harness.set(settingsOf(given));
    const glm::ivec2 size(given.integer("picture"));
    const std::vector<std::string> views = viewsOf(chapter);
    const std::string& view = views[std::size_t(given.integer("variant")) % views.size()];
    const std::string found = notFinite(harness.picture(view, size, 3));
    if (!found.empty()) verdict.fail(fmt::format("--view {}: {}", view, found));
    return verdict;
}

const AddSubject finite({.name = "finite-pictures",
                         .claim = "no view of any chapter holds a NaN or an infinity, whatever the scene",
                         .axes = {"chapter", "light-type", "depth-format", "shape", "light-angle", "scale",
                                  "distance", "aside", "fov", "map-size", "picture", "radius", "light-size",
                                  "variant"},
                         .check = check});

}  // namespace
}  // namespace penumbra::stress
