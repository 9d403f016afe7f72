#include "tests/stress/any_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/image/lit_scenes.h"
#include "tests/stress/placement.h"
#include "tests/stress/triangle_shapes.h"

namespace penumbra::stress {

namespace {

std::string methodOf09(const Case& given) {
    const std::vector<std::string> methods{"rays", "hemisphere", "vertices", "triangles", "bits"};
    return methods[std::size_t(given.integer("variant") / 5) % methods.size()];
}

}  // namespace

Scene anyScene(const Case& given) {
    Dice dice(std::uint64_t(given.integer("variant")));
    const glm::dvec3 eye(0.4, 1.5, 2.2);
    const Placement placement(given, eye, dice);
    std::vector<Triangle> triangles{{glm::dvec3(-2, 0, 2), glm::dvec3(2, 0, 2), glm::dvec3(2, 0, -2)},
                                    {glm::dvec3(-2, 0, 2), glm::dvec3(2, 0, -2), glm::dvec3(-2, 0, -2)}};
    const TrianglePlace place{{0.1, 0.4, -0.1}, 0.8, {0, 1, 0}};
    for (const Triangle& t : trianglesOf(given.choice("shape"), place, dice)) triangles.push_back(t);
    Scene scene = drawnScene(placement.triangles(std::move(triangles)));
    const double angle = given.number("light-angle") * radians;
    const glm::dvec3 toLight(std::sin(angle), std::cos(angle), 0.0);
    scene.lights.push_back(lightOf(given, placement, {0, 0, 0}, toLight, 3.0, 0.6));
    scene.cameras.push_back(cameraOf(placement, eye, {0, 0, 0}, given.number("fov") * radians));
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
    Settings settings;
    if (chapter == "00" || chapter == "09") {
        const std::string method = chapter == "09" ? methodOf09(given) : "";
        settings.emplace_back("samples", method == "bits" ? "64" : "8");
        if (chapter == "09") settings.emplace_back("method", method);
        return settings;
    }
    settings.emplace_back("map-size", std::to_string(given.integer("map-size")));
    if (chapter == "08") {
        settings.emplace_back("samples", "16");
        settings.emplace_back("others-samples", "2");
        settings.emplace_back("texel-budget", "4");
    } else if (chapter == "10" || chapter == "11") {
        settings.emplace_back("samples", "8");
        if (chapter == "11") settings.emplace_back("source", "maps");
    } else {
        settings.emplace_back("depth-format", given.choice("depth-format"));
        if (chapter == "06" || chapter == "07") settings.emplace_back("samples", "8");
        if (chapter >= "05") settings.emplace_back("radius", fmt::format("{}", given.number("radius")));
    }
    return settings;
}

std::string programsOf(const Case& given) {
    const std::string chapter = given.choice("chapter");
    if (chapter != "06" && chapter != "07") return "any";
    return "any " + given.choice("light-type") + " " + given.choice("depth-format");
}

}  // namespace penumbra::stress
