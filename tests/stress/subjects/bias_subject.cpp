// The derived bias (chapter 03): at 1 times the bound nothing shadows itself, whatever method spends it, and
// whatever kernel chapters 04 to 07 filter with.
#include <fmt/format.h>

#include <cmath>

#include "tests/stress/gl_stage.h"
#include "tests/stress/lone_surface.h"

namespace penumbra::stress {
namespace {

/// The bound is capped at 85 degrees, beyond which light is too faint to matter.
const double faint = std::cos(84.9 * radians);

/// Red in --view shadow-kind: the surface faces the light, and the map says that something is in between.
bool saysCast(const FloatImage& kind, int x, int y) {
    return kind.at(x, y, 0) - kind.at(x, y, 2) > 1e-4f;
}

/// Pixels of the surface that the map calls dark.
struct DarkPixels {
    int lit = 0;    ///< light comes in at less than 85 degrees: none may be
    int faint = 0;  ///< at more: measured
};

DarkPixels darkPixels(const LoneSurface& surface, const FloatImage& kind, const Case& given, double kernel) {
    const LightFrustum frustum = surface.frustum(given.choice("depth-format"));
    const int size = kind.width, mapSize = given.integer("map-size");
    DarkPixels dark;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (!saysCast(kind, x, y)) continue;
            const glm::dvec3 p = surface.point(x, y, size);
            if (surface.behindSpot(p) || besideSmallCaster(surface, frustum, mapSize, p, 3.0 + 1.5 * kernel))
                continue;
            ++(surface.cosine(p) >= faint ? dark.lit : dark.faint);
        }
    }
    return dark;
}

Verdict judge(const LoneSurface& surface, const FloatImage& kind, const Case& given, double kernel) {
    Verdict verdict;
    const std::string found = notFinite(kind);
    if (!found.empty()) verdict.fail(found);
    const DarkPixels dark = darkPixels(surface, kind, given, kernel);
    const double all = double(kind.width) * kind.height;
    if (promised(given)) {
        verdict.expectAtMost("dark pixels", dark.lit, 0.0);
        verdict.measure("share of pixels that shadow themselves where light comes in at 85 degrees or more",
                        dark.faint / all);
    }
    verdict.measure("share of dark pixels, however far aside", dark.lit / all);
    return verdict;
}

Settings mapSettings(const LoneSurface& surface, const Case& given) {
    return {{"depth-format", given.choice("depth-format")},
            {"map-size", std::to_string(given.integer("map-size"))},
            {"fit", surface.fitToView ? "view" : "scene"},
            {"bias", "1"}};
}

const std::vector<std::string> lightAxes{"light-type", "depth-format", "light-angle", "scale",
                                         "distance",   "aside",        "fov",         "map-size",
                                         "near-far",   "picture",      "variant"};

std::vector<std::string> with(std::vector<std::string> axes, const std::vector<std::string>& more) {
    axes.insert(axes.begin(), more.begin(), more.end());
    return axes;
}

Verdict checkBias(const Case& given) {
    LoneSurface surface = loneSurface(given);
    ChapterHarness& harness = shown("03", "", surface.scene);
    harness.set(mapSettings(surface, given));
    harness.set("method", given.choice("method"));
    return judge(surface, harness.picture("shadow-kind", glm::ivec2(given.integer("picture")), 3), given,
                 0.0);
}

Verdict checkFilter(const Case& given) {
    LoneSurface surface = loneSurface(given);
    const std::string chapter = given.choice("filter");
    const std::string kept = chapter >= "06" ? given.choice("light-type") + given.choice("depth-format") : "";
    ChapterHarness& harness = shown(chapter, kept, surface.scene);
    harness.set(mapSettings(surface, given));
    const bool follows = given.integer("variant") % 4 < 2;
    harness.set("receiver-plane", follows ? "true" : "false");
    const double radius = given.number("radius");
    const int width = std::clamp(int(radius), 1, 15);
    if (chapter == "04") {
        harness.set({{"kernel-width", std::to_string(width)},
                     {"bilinear", given.integer("variant") % 3 == 0 ? "true" : "false"}});
    } else {
        harness.set({{"radius", fmt::format("{}", radius)}, {"samples", "8"}});
    }
    const double kernel = chapter == "04" ? 0.5 * width + 1.0 : radius + 1.0;
    return judge(surface, harness.picture("shadow-kind", glm::ivec2(given.integer("picture")), 3), given,
                 kernel);
}

const AddSubject bias(
    {.name = "bias",
     .claim = "at 1 times the derived bound nothing that light meets at less than 85 degrees shadows itself "
              "(03), however the bound is spent",
     .axes = with(lightAxes, {"method"}),
     .check = checkBias,
     .share = 3.0});
const AddSubject filter(
    {.name = "filter",
     .claim = "nor does any tap of a filter (04 to 07), with or without following the plane",
     .axes = with(lightAxes, {"filter", "radius"}),
     .check = checkFilter,
     .share = 1.0});

}  // namespace
}  // namespace penumbra::stress
