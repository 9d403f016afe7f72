// Chapter 08: the share of an area light that is seen is a share, and no shadow makes anything brighter.
#include <algorithm>
#include <numbers>

#include "common/truth/exact_scene.h"
#include "common/truth/polygon_light.h"
#include "tests/stress/any_scene.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/lone_surface.h"
#include "tests/stress/placement.h"
#include "tests/stress/receiver_texels.h"

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

/// Where the ray through `pixel` meets the ground.
glm::dvec3 groundAt(const Scene& scene, const glm::dvec3& n, const glm::dvec2& pixel, int size) {
    const Ray ray = cameraRay(scene.cameras[0], pixel, glm::ivec2(size));
    const double t = glm::dot(glm::dvec3(scene.positions[0]) - ray.origin, n) / glm::dot(ray.direction, n);
    return ray.origin + t * ray.direction;
}

/// What arrives at the ground with nothing in between, exactly, and what float arithmetic may add to it.
struct Arriving {
    double light = 0.0, rounding = 0.0;
};

/// Blended between the texels of a receiver's texture of light.
Arriving onTexture(const Receiver& receiver, const Light& light, const glm::dvec3& p, double metresBeside) {
    const auto whole = [&](const glm::ivec2& texel) {
        return light.emission.x * unoccluded(receiver, light, texel);
    };
    const TexelBlend blend(receiver, p);
    const double texelsPerMetre = std::max(receiver.texels.x / glm::length(receiver.uEdge),
                                           receiver.texels.y / glm::length(receiver.vEdge));
    const double beside = 2.0 * (texelsBeside(receiver, p) + texelsPerMetre * metresBeside);
    const double most = blend.of(whole) + blend.range(whole);
    // The texture's entries, the sums' ratio, three products and the blend: 24 roundings.
    return {blend.of(whole), 24.0 * 0x1p-24 * most + beside * blend.range(whole)};
}

/// Surfaces without a texture: Lambert's formula in floats (lambert.glsl). Of its eight edges at most each is
/// an angle times a cosine; rounded corners turn both by 2 d, d being what they are off by over their
/// distance, and a dozen roundings come on top. Of a small light these terms all but cancel: what is left of
/// them is not relative to the light.
Arriving byFloats(const Light& light, const glm::dvec3& n, const glm::dvec3& p, double metresBeside) {
    double sum = 0.0, nearest = 1e300, largest = glm::length(p);
    for (const auto& polygon : light.polygons) {
        sum += std::numbers::pi * formFactor(p, n, polygon);
        for (const glm::dvec3& corner : polygon)
            nearest = std::min(nearest, glm::length(corner - p)),
            largest = std::max(largest, glm::length(corner));
    }
    const double turned = (0x1p-22 * largest + metresBeside) / nearest;
    return {light.emission.x * sum,
            light.emission.x * 0.5 * 8.0 * (4.0 * turned + 12.0 * std::numbers::pi * 0x1p-24)};
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
    ChapterHarness& harness = shown("08", "shares", anyScene(given));
    harness.set(settings);
    const FloatImage share = harness.picture("visibility", glm::ivec2(size), 3),
                     lit = harness.picture("irradiance", glm::ivec2(size), 3);
    for (const FloatImage* image : {&share, &lit})
        if (const std::string found = notFinite(*image); !found.empty()) verdict.fail(found);
    for (const float value : share.values) {
        verdict.expectAtMost("visibility above 1", double(value) - 1.0, 1e-6);
        verdict.expectAtMost("visibility below 0", -double(value), 0.0);
    }
    if (!promised(given)) return verdict;
    const Scene& scene = harness.scene;
    const Light& light = scene.lights[0];
    const ExactScene exact(scene);
    const glm::dvec3 corner(scene.positions[0]);
    glm::dvec3 n = glm::normalize(
        glm::cross(glm::dvec3(scene.positions[1]) - corner, glm::dvec3(scene.positions[2]) - corner));
    std::vector<Receiver> receivers;
    if (methods[std::size_t(variant) % 4] != "shadow-maps")
        for (const std::uint32_t triangle : {0u, 1u})
            for (const Receiver& receiver : receiversOf(scene, triangle, 0.05, n))
                receivers.push_back(receiver);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (!(lit.at(x, y, 0) > 0.0f) || !seesGround(scene, exact, x, y, size)) continue;
            const glm::dvec3 p = groundAt(scene, n, {x + 0.5, y + 0.5}, size);
            const double pixel = std::max(glm::length(groundAt(scene, n, {x + 1.0, y + 0.5}, size) - p),
                                          glm::length(groundAt(scene, n, {x + 0.5, y + 1.0}, size) - p));
            const double metres = 2.0 * pixel * pixelsBeside(scene, halfSubpixel(), size, p);
            // Two triangles that are not quite in one plane have a texture each.
            double gained = 1e300, brightest = 0.0;
            std::vector<Arriving> may;
            for (const Receiver& receiver : receivers) may.push_back(onTexture(receiver, light, p, metres));
            if (receivers.empty()) may.push_back(byFloats(light, n, p, metres));
            for (const Arriving& arriving : may) {
                gained =
                    std::min(gained, (lit.at(x, y, 0) - arriving.light) / std::max(arriving.rounding, 1e-30));
                brightest = std::max(brightest, arriving.light);
            }
            verdict.expectAtMost(receivers.empty() ? "light gained without a texture, over the rounding"
                                                   : "light gained by a shadow, over the rounding",
                                 gained, 1.0);
            verdict.measure(receivers.empty() ? "light gained without a texture, of what arrives"
                                              : "light gained by a shadow, of what arrives",
                            lit.at(x, y, 0) / std::max(brightest, 1e-30) - 1.0);
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
