// A bias lets light through under whatever is nearer to the surface than it is deep, and under nothing else:
// what stands farther off than the bound (chapter 03) shadows.
#include <cmath>

#include "chapters/03_polygon_offset/depth_bias.h"
#include "common/scene/light.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/placement.h"

namespace penumbra::stress {
namespace {

constexpr double lightDistance = 3.0;
constexpr double seen = 0.5;  ///< metres of the ground in the picture

/// Ground, and a sheet parallel to it `gap` metres higher; a flat camera between the two looks down.
struct Sheet {
    Scene scene;
    glm::dvec3 up{0.0};
    LightFrustum frustum;
};

Sheet sheetAbove(const Case& given, double gap) {
    Dice dice(std::uint64_t(given.integer("variant")));
    const Placement placement(given, glm::dvec3(0.0), dice);
    const double angle = given.number("light-angle") * radians;
    const glm::dvec3 toLight(std::sin(angle), std::cos(angle), 0.0), height(0.0, gap, 0.0);
    const std::vector<Triangle> local{
        {glm::dvec3(-4, 0, 4), glm::dvec3(4, 0, 4), glm::dvec3(0, 0, -4)},
        {height + glm::dvec3(-3, 0, 3), height + glm::dvec3(3, 0, 3), height + glm::dvec3(0, 0, -3)}};
    Sheet sheet;
    sheet.scene = drawnScene(placement.triangles(local));
    sheet.scene.lights.push_back(lightOf(given, placement, {0, 0, 0}, toLight, lightDistance, 0.7));
    sheet.scene.cameras.push_back(cameraOf(placement, {0, 0.5 * gap, 0}, {0, 0, 0}, 1.0));
    Camera& camera = sheet.scene.cameras[0];
    camera.orthographic = true;
    camera.height = placement.length(seen);
    camera.near = placement.length(0.01 * gap);
    camera.far = placement.length(0.8 * gap);
    sheet.up = placement.direction({0, 1, 0});
    const DepthRange range =
        given.choice("depth-format") == "32f-reversed" ? DepthRange::reversed : DepthRange::standard;
    sheet.frustum = fitLightFrustum(sheet.scene, sheet.scene.lights[0], range);
    return sheet;
}

/// Window depth of `p`, the larger the farther from the light, and the bound there in double, with `widest`
/// for the slope where floats cannot tell it.
double boundAt(const Sheet& sheet, const DepthErrors& errors, int mapSize, const glm::dvec3& p) {
    const glm::dmat4 m = sheet.frustum.textureFromWorld();
    const double q = (m * glm::dvec4(p, 1.0)).w, z = (m * glm::dvec4(p, 1.0)).z / q;
    // The shader bounds the slope by what 85 degrees ask for at most, and its arithmetic by what it finds it
    // is off.
    const double slope = steepestSlope(sheet.frustum) / q, found = 9.0;
    const double lateral = found * (errors.rounding.x + errors.rounding.z) / q * slope;
    const double S = (0.5 + errors.snap) / mapSize * slope + lateral;
    const double Q = errors.quantum.x + errors.quantum.y * std::abs(z);
    const double C = found * (errors.rounding.y + std::abs(z) * errors.rounding.z) / q +
                     errors.rasterError.x + errors.rasterError.y * (std::abs(z) + slope);
    return S + Q + C;
}

/// Of the sheet's distance in window depth, along the light's ray to the corners and the middle of the
/// picture, over twice the bound: the map's texel lies up to the bound beside the sheet as well. The
/// smallest.
double bounds(const Case& given, const Sheet& sheet, const DepthErrors& errors, double gapMetres) {
    double least = 1e300;
    const glm::dmat4 m = sheet.frustum.textureFromWorld();
    const auto depth = [&](const glm::dvec3& p) {
        const glm::dvec4 h = m * glm::dvec4(p, 1.0);
        const double z = h.z / h.w;
        return sheet.frustum.range == DepthRange::reversed ? 1.0 - z : z;
    };
    for (const glm::dvec2& at :
         {glm::dvec2(0.5), glm::dvec2(0), glm::dvec2(0, 1), glm::dvec2(1, 0), glm::dvec2(1)}) {
        const Ray ray = cameraRay(sheet.scene.cameras[0], at, glm::ivec2(1));
        const glm::dvec3 p = ray.origin + ray.direction * (0.5 * gapMetres);
        const glm::dvec3 l = directionToLight(sheet.scene.lights[0], p);
        const glm::dvec3 above = p + l * (gapMetres / std::abs(glm::dot(l, sheet.up)));
        least = std::min(
            least, (depth(p) - depth(above)) / (2.0 * boundAt(sheet, errors, given.integer("map-size"), p)));
    }
    return least;
}

Verdict check(const Case& given) {
    Verdict verdict;
    // The gap at which the sheet is exactly twice the bound away: the depth of the gap grows with it, the
    // bound hardly.
    double gap = 1e-3;
    Sheet sheet = sheetAbove(given, gap);
    for (int i = 0; i < 12; ++i) {
        const DepthErrors errors =
            depthErrors(depthFormat(given.choice("depth-format"), testContext().capabilities()),
                        sheet.frustum, sheet.scene.bounds, 3 * transformOperations);
        const double over = bounds(given, sheet, errors, gap * given.number("scale"));
        if (over >= 1.0 && over < 1.1) break;
        gap *= std::clamp(1.05 / std::max(over, 1e-6), 1e-3, 1e3);
        verdict.measured["gap that shadows, of the scene's size"] = gap;
        // Beyond, the sheet's own edges come into the picture: the bound is as deep as the scene is large.
        if (!(gap < 0.5 / std::max(1.0, std::tan(given.number("light-angle") * radians)))) return verdict;
        sheet = sheetAbove(given, gap);
    }
    ChapterHarness& harness = shown("03", "leak", sheet.scene);
    harness.set("depth-format", given.choice("depth-format"));
    harness.set("map-size", std::to_string(given.integer("map-size")));
    harness.set("fit", "scene");
    harness.set("bias", "1");
    harness.set("method", "slope");
    const FloatImage visibility = harness.scalar("visibility", glm::ivec2(given.integer("picture")));
    double lit = 0.0;
    for (const float value : visibility.values) lit += value != 0.0f;
    // The texel's own depth is as far beside as the true slope has it, and the bound's slope ends at 85
    // degrees.
    if (given.number("light-angle") <= 84.9)
        verdict.expectAtMost("pixels lit through a sheet farther off than the bound", lit, 0.0);
    return verdict;
}

const AddSubject leak(
    {.name = "leak",
     .claim = "what stands farther off than the derived bound shadows, up to 85 degrees (03)",
     .axes = {"light-type", "depth-format", "light-angle", "scale", "distance", "aside", "map-size",
              "picture", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
