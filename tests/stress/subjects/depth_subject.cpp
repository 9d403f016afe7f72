// Chapter 01: every texel of the map is the exact depth behind its centre, to half a step of the format and
// what arithmetic rounds away.
#include <algorithm>
#include <cmath>

#include "tests/stress/gl_stage.h"
#include "tests/stress/lone_surface.h"
#include "tests/stress/map_oracle.h"

namespace penumbra::stress {
namespace {

Verdict check(const Case& given) {
    Verdict verdict;
    const LoneSurface surface = shadowedSurface(given);
    const std::string format = given.choice("depth-format");
    const int mapSize = given.integer("map-size");
    ChapterHarness& harness = shown("01", "", surface.scene);
    harness.set({{"depth-format", format},
                 {"map-size", std::to_string(mapSize)},
                 {"fit", surface.fitToView ? "view" : "scene"}});
    // As many pixels as texels: each shows one, as it is.
    const FloatImage depths = harness.scalar("depth", glm::ivec2(mapSize));
    if (const std::string found = notFinite(depths); !found.empty()) verdict.fail(found);

    const LightFrustum frustum = surface.frustum(format);
    const DepthErrors errors = depthErrors(depthFormat(format, harness.capabilities()), frustum,
                                           surface.scene.bounds, transformOperations);
    const MapOracle map(surface.scene, frustum, mapSize, errors);
    double over = 0.0, wrong = 0.0, edges = 0.0;
    for (int y = 0; y < mapSize; ++y) {
        for (int x = 0; x < mapSize; ++x) {
            const double z = depths.at(x, mapSize - 1 - y);
            const StoredDepth right = map.stored({x, y});
            edges += !right.sure;
            if (!right.sure) wrong += !(z >= right.low && z <= right.high);
            const double bound = 0.5 * (right.high - right.low);
            if (right.sure)
                over = std::max(over, bound > 0.0        ? std::abs(z - right.exact) / bound
                                      : z == right.exact ? 0.0
                                                         : 1e9);
        }
    }
    verdict.measure("share of texels beside an edge", edges / (double(mapSize) * mapSize));
    if (promised(given)) {
        verdict.expectAtMost("depth off the exact one, over half a step and the arithmetic", over, 1.0);
        verdict.expectAtMost("texels on an edge that hold neither side", wrong, 0.0);
    }
    return verdict;
}

const AddSubject depth(
    {.name = "depth",
     .claim = "every texel of a shadow map (01) is the exact depth behind its centre, to half a step of the "
              "format and the derived rounding",
     .axes = {"shape", "light-type", "depth-format", "light-angle", "scale", "distance", "aside", "fov",
              "map-size", "near-far", "variant"},
     .check = check,
     .share = 0.3});

}  // namespace
}  // namespace penumbra::stress
