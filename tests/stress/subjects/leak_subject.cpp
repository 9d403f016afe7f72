// A bias lets light through under whatever is nearer to the surface than it is deep, and under nothing else:
// what stands farther off than the bound (chapter 03) shadows.
#include <algorithm>
#include <cmath>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "common/scene/light.h"
#include "common/truth/shadow_packet.h"
#include "tests/stress/bias_bound.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/lone_surface.h"
#include "tests/stress/map_oracle.h"
#include "tests/stress/placement.h"

namespace penumbra::stress {
namespace {

constexpr double lightDistance = 3.0;
constexpr double seen = 0.5;  ///< metres of the ground in the picture

/// Ground, and a sheet parallel to it `gap` metres higher; a flat camera between the two looks down.
struct Sheet {
    Scene scene;
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
    const DepthRange range =
        given.choice("depth-format") == "32f-reversed" ? DepthRange::reversed : DepthRange::standard;
    sheet.frustum = fitLightFrustum(sheet.scene, sheet.scene.lights[0], range);
    return sheet;
}

glm::dvec3 normalOf(const Scene& scene, std::size_t first) {
    const glm::dvec3 a(scene.positions[first]);
    return glm::normalize(
        glm::cross(glm::dvec3(scene.positions[first + 1]) - a, glm::dvec3(scene.positions[first + 2]) - a));
}

/// Where the line from `p` along `d` meets the plane of the triangle that begins with corner `first`, as it
/// is when rounded to float.
glm::dvec3 onPlane(const Scene& scene, std::size_t first, const glm::dvec3& p, const glm::dvec3& d) {
    const glm::dvec3 a(scene.positions[first]);
    const glm::dvec3 n =
        glm::cross(glm::dvec3(scene.positions[first + 1]) - a, glm::dvec3(scene.positions[first + 2]) - a);
    return p + d * (glm::dot(a - p, n) / glm::dot(d, n));
}

/// Of the sheet's distance in window depth, along the light's ray to the corners and the middle of the
/// picture, over what shadows surely: the bias that the shader takes at most, and what the depths of the
/// map's texel and of the point may be off by, of which half a texel's slope is the larger part. The
/// smallest.
double bounds(const Case& given, const Sheet& sheet, const DepthErrors& errors) {
    double least = 1e300;
    const int picture = given.integer("picture");
    const glm::dmat4 m = sheet.frustum.textureFromWorld();
    const auto depth = [&](const glm::dvec3& p) {
        const glm::dvec4 h = m * glm::dvec4(p, 1.0);
        const double z = h.z / h.w;
        return sheet.frustum.range == DepthRange::reversed ? 1.0 - z : z;
    };
    const auto ground = [&](const glm::dvec2& pixel) {
        const Ray ray = cameraRay(sheet.scene.cameras[0], pixel, glm::ivec2(picture));
        return onPlane(sheet.scene, 0, ray.origin, ray.direction);
    };
    const glm::dvec3 corner = ground({0.0, 0.0});
    const glm::dvec4 dx = m * glm::dvec4(ground({1.0, 0.0}) - corner, 0.0),
                     dy = m * glm::dvec4(ground({0.0, 1.0}) - corner, 0.0);
    for (const glm::dvec2& at :
         {glm::dvec2(0.5), glm::dvec2(0), glm::dvec2(0, 1), glm::dvec2(1, 0), glm::dvec2(1)}) {
        const glm::dvec3 p = ground(at * double(picture));
        const glm::dvec3 l = directionToLight(sheet.scene.lights[0], p);
        const glm::dvec3 above = onPlane(sheet.scene, 3, p, l);
        const BiasBound bound(sheet.frustum, errors, given.integer("map-size"), m * glm::dvec4(p, 1.0), dx,
                              dy);
        // Nearer to a lamp the sheet is steeper on the map than the ground.
        const glm::dvec2 slope = depthSlope(m, above, normalOf(sheet.scene, 3));
        least = std::min(least, (depth(p) - depth(above)) / (bound.bias() + bound.asked(slope)));
    }
    return least;
}

/// Are the texels that pixel (x, y) may be tested with on the map, and does the sheet surely cover them? A
/// point light's map has an end (widestHalfAngle), and a texel may be as large as the sheet.
bool isUnderSheet(const Sheet& sheet, const MapOracle& map, int x, int y, int picture, int mapSize) {
    const Ray ray = cameraRay(sheet.scene.cameras[0], {x + 0.5, y + 0.5}, glm::ivec2(picture));
    const glm::dvec4 h = sheet.frustum.textureFromWorld() *
                         glm::dvec4(onPlane(sheet.scene, 0, ray.origin, ray.direction), 1.0);
    if (!(h.w > 0.0)) return false;
    const glm::dvec2 at = glm::dvec2(h) / h.w * double(mapSize);
    for (const glm::dvec2& beside : {glm::dvec2(-0.25), {-0.25, 0.25}, {0.25, -0.25}, {0.25, 0.25}}) {
        const glm::ivec2 texel(glm::floor(at + beside));
        const bool outside = std::min(texel.x, texel.y) < 0 || std::max(texel.x, texel.y) >= mapSize;
        if (outside || !std::isfinite(map.shadow(texel).dark)) return false;
    }
    return true;
}

Verdict check(const Case& given) {
    Verdict verdict;
    // The gap at which the sheet is exactly that far away: the depth of the gap grows with it, the bound
    // hardly; but the frustum is fitted to both.
    double gap = 1e-3;
    Sheet sheet = sheetAbove(given, gap);
    const DepthFormat format = depthFormat(given.choice("depth-format"), testContext().capabilities());
    const auto timesTheBound = [&] {
        return bounds(given, sheet,
                      depthErrors(format, sheet.frustum, sheet.scene.bounds, 3 * transformOperations));
    };
    double over = timesTheBound();
    for (int i = 0; i < 12 && !(over >= 1.0 && over < (i < 6 ? 1.1 : 1.5)); ++i) {
        // No nearer than floats can place it and a camera below it: then it is farther off than it must be.
        const double least = 64.0 * 0x1p-23 * largestCoordinate(sheet.scene.bounds) / given.number("scale");
        if (over >= 1.0 && gap <= least) break;
        gap = std::max(least, gap * std::clamp(1.05 / std::max(over, 1e-6), 1e-3, 1e3));
        // Beyond, the sheet's own edges come into the picture: the bound is as deep as the scene is large.
        if (!(gap < 0.5 / std::max(1.0, std::tan(given.number("light-angle") * radians)))) {
            verdict.refusal = "nothing is promised: the bound is as deep as the scene is large";
            return verdict;
        }
        sheet = sheetAbove(given, gap);
        over = timesTheBound();
    }
    if (!(over >= 1.0)) {
        verdict.refusal = "nothing is compared: rounded, no sheet is as far off as the bound";
        return verdict;
    }
    if (!seesGroundAlone({sheet.scene})) return nothingSeen();
    verdict.measured["gap that shadows, of the scene's size"] = gap;
    ChapterHarness& harness = shown("03", "leak", sheet.scene);
    harness.set("depth-format", given.choice("depth-format"));
    harness.set("map-size", std::to_string(given.integer("map-size")));
    harness.set("fit", "scene");
    harness.set("bias", "1");
    harness.set("method", "slope");
    const FloatImage visibility = harness.scalar("visibility", glm::ivec2(given.integer("picture")));
    const MapOracle map(sheet.scene, sheet.frustum, given.integer("map-size"),
                        depthErrors(format, sheet.frustum, sheet.scene.bounds, transformOperations));
    double lit = 0.0, under = 0.0;
    for (int y = 0; y < visibility.height; ++y) {
        for (int x = 0; x < visibility.width; ++x) {
            if (!isUnderSheet(sheet, map, x, y, visibility.width, given.integer("map-size"))) continue;
            under += 1.0;
            lit += visibility.at(x, y) != 0.0f;
        }
    }
    verdict.measure("pixels under a sheet", under);
    verdict.expectAtMost("pixels lit through a sheet farther off than the bound", lit, 0.0);
    return verdict;
}

const AddSubject leak(
    {.name = "leak",
     .claim = "what stands farther off than the derived bound shadows, up to 89.9 degrees (03)",
     .axes = {"light-type", "depth-format", "light-angle", "scale", "distance", "aside", "map-size",
              "picture", "variant"},
     .check = check});

}  // namespace
}  // namespace penumbra::stress
