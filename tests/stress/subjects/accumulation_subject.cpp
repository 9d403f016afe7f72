// Chapter 08: the share of an area light that is seen is a share, and no shadow makes anything brighter.
#include <fmt/format.h>

#include "common/truth/exact_scene.h"
#include "tests/stress/any_scene.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/placement.h"

namespace penumbra::stress {
namespace {

/// Does the camera see the ground in all of pixel (x, y), by a margin of half a pixel?
bool seesGround(const Scene& scene, const ExactScene& exact, int x, int y, int size) {
    const glm::dvec3 corner(scene.positions[0]);
    const glm::dvec3 n =
        glm::cross(glm::dvec3(scene.positions[1]) - corner, glm::dvec3(scene.positions[2]) - corner);
    for (int i = 0; i < 9; ++i) {
        const glm::dvec2 at(x - 0.5 + i % 3, y - 0.5 + i / 3);  // an int division: three rows of three
        const Ray ray = cameraRay(scene.cameras[0], at, glm::ivec2(size));
        const double t = glm::dot(corner - ray.origin, n) / glm::dot(ray.direction, n);
        if (!(t > 0.0)) return false;
        if (exact.occluded(ray.origin, noTriangle, ray.origin + 0.999 * t * ray.direction)) return false;
    }
    return true;
}

Verdict check(const Case& drawn) {
    Verdict verdict;
    Case given = drawn;
    given.values["chapter"] = axisNamed("chapter").parse("08");
    const std::vector<std::string> methods{"mask", "accumulate", "shadow-maps", "exact"};
    const std::vector<std::string> patterns{"owen-sobol", "regular", "jittered", "fibonacci"};
    const int variant = given.integer("variant"), size = given.integer("picture");
    Settings settings = settingsOf(given);
    settings.emplace_back("method", methods[std::size_t(variant) % 4]);
    settings.emplace_back("pattern", patterns[std::size_t(variant / 4) % 4]);
    settings.emplace_back("samples", std::to_string(std::min(given.integer("samples"), 64)));
    ChapterHarness& shadowed = shown("08", "shares", anyScene(given));
    shadowed.set(settings);
    const FloatImage share = shadowed.picture("visibility", glm::ivec2(size), 3),
                     lit = shadowed.picture("irradiance", glm::ivec2(size), 3);
    ChapterHarness& lowered = shown("08", "lowered", anyScene(given, 5.0));
    lowered.set(settings);
    const FloatImage open = lowered.picture("irradiance", glm::ivec2(size), 3);
    for (const FloatImage* image : {&share, &lit, &open})
        if (const std::string found = notFinite(*image); !found.empty()) verdict.fail(found);
    for (const float value : share.values) {
        verdict.expectAtMost("visibility above 1", double(value) - 1.0, 1e-6);
        verdict.expectAtMost("visibility below 0", -double(value), 0.0);
    }
    // Beyond 85 degrees a shadow map may call a surface dark, and take from the open ground's light as well.
    const bool maps = methods[std::size_t(variant) % 4] == "shadow-maps";
    if (maps || !promised(given)) return verdict;
    const Scene& scene = shadowed.scene;
    const ExactScene exact(scene);
    float brightest = 0.0f;
    for (const float value : open.values) brightest = std::max(brightest, value);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float with = lit.at(x, y, 0), without = open.at(x, y, 0);
            if (!(with > without) || !seesGround(scene, exact, x, y, size)) continue;
            // Lowered triangles leave the ground another share of the texels, and light is interpolated
            // between them: off by h^2/8 times its second derivative, about 5/d^2 of itself at d = 3 metres;
            // texels are h = 4/30 metres.
            verdict.expectAtMost("light gained by a shadow, of the brightest",
                                 double(with - without) / std::max(double(brightest), 1e-30), 2e-3);
        }
    }
    return verdict;
}

const AddSubject accumulation(
    {.name = "accumulation",
     .claim = "08: visibility lies in [0,1], and what stands in the way never adds light",
     .axes = {"shape", "light-angle", "light-size", "scale", "distance", "aside", "fov", "map-size",
              "picture", "samples", "variant"},
     .check = check,
     .share = 0.08});

}  // namespace
}  // namespace penumbra::stress
