// Chapters 09 and 10: ambient visibility is the share of its own directions that exact geometry calls open.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/03_polygon_offset/depth_bias.h"
#include "chapters/10_accumulated_occlusion/direction_batches.h"
#include "chapters/10_accumulated_occlusion/sky_directions.h"
#include "chapters/10_accumulated_occlusion/sky_maps.h"
#include "common/math/hemisphere.h"
#include "common/math/sampling.h"
#include "common/truth/shadow_packet.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/lone_surface.h"
#include "tests/stress/map_oracle.h"
#include "tests/stress/ray_oracle.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

constexpr int mostPixels = 24;  ///< of a side: each is decided triangle by triangle

/// Weights of directions.
struct Open {
    double open = 0.0, unknown = 0.0, all = 0.0;

    /// How far `A` lies outside of what is right, over `tolerance`.
    double off(double A, double tolerance) const {
        return std::max(open / all - A, A - (open + unknown) / all) / tolerance;
    }
};

/// The normal on the side of the camera.
glm::dvec3 facingNormal(const LoneSurface& surface) {
    const glm::dvec3 n = surface.normal();
    return glm::dot(n, surface.scene.cameras[0].forward) > 0.0 ? -n : n;
}

/// A share of that a picture has settled, for the reader to see that something was decided.
void report(Verdict& verdict, const Case& given, double off, double settled) {
    if (promised(given))
        verdict.expectAtMost("ambient visibility beside the share of directions, over its rounding", off,
                             1.0);
    verdict.measure("pixels in half-shadow of which every direction is known", settled);
}

/// Between the settled answers a float holds the sum of so many weights.
double rounding(int directions) {
    return (directions + 4.0) * 0x1p-23;
}

// --- 09: rays ---

/// What a ray meets by less than decisiveUlps, floats may miss (shadow_packet.h).
Open exactRays(const LoneSurface& surface, const std::vector<Triangle>& triangles, const glm::dvec3& p,
               const glm::dvec3& n, int count, bool uniform, double range, std::uint32_t seed) {
    const glm::dmat3 worldFromNormal = frameAround(n);
    Open sum;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 u = owenSobol(std::uint32_t(i), seed);
        const glm::dvec3 w = worldFromNormal * (uniform ? uniformDirection(u) : cosineDirection(u));
        ShadowRay ray{.origin = p, .target = w, .normal = n, .triangle = 0, .towardsInfinity = range == 0.0};
        if (range > 0.0) ray.target = p + range * w;
        const BlockedBy blocked = blockedBy(ray, triangles);
        const double ulp = ulpOf(ray, largestCoordinate(surface.scene.bounds));
        const bool surelyOpen =
            blocked.known<-0x1p-10 * ulp, surelyBlocked = blocked.exact> decisiveUlps * ulp;
        sum.all += 1.0;
        sum.open += surelyOpen;
        sum.unknown += !surelyOpen && !surelyBlocked;
    }
    return sum;
}

Verdict checkRays(const Case& given) {
    Verdict verdict;
    const LoneSurface surface = shadowedSurface(given);
    if (!seesGroundAlone(surface)) return nothingSeen();
    const int variant = given.integer("variant"), count = std::clamp(given.integer("samples"), 1, 32),
              picture = std::min(given.integer("picture"), mostPixels);
    const bool uniform = variant % 2 == 1;
    const float range = variant % 3 == 1 ? std::min(1000.0f, float(0.7 * given.number("scale"))) : 0.0f;
    ChapterHarness& harness = shown("09", "rays", surface.scene);
    harness.set({{"method", "rays"},
                 {"samples", std::to_string(count)},
                 {"weighting", uniform ? "uniform" : "cosine"},
                 {"range", fmt::format("{}", range)}});
    const FloatImage A = harness.scalar("ambient", glm::ivec2(picture));
    harness.set("range", "0");
    harness.set("weighting", "cosine");
    if (const std::string found = notFinite(A); !found.empty()) verdict.fail(found);
    const std::vector<Triangle> triangles = trianglesIn(surface.scene);
    const glm::dvec3 n = facingNormal(surface);
    double off = 0.0, settled = 0.0;
    for (int y = 0; y < picture; ++y) {
        for (int x = 0; x < picture; ++x) {
            const Open open = exactRays(surface, triangles, surface.point(x, y, picture), n, count, uniform,
                                        double(range), hashSeed(std::uint32_t(x), std::uint32_t(y), 0));
            off = std::max(off, open.off(A.at(x, y), rounding(count)));
            settled += open.unknown == 0.0 && open.open > 0.0 && open.open < open.all;
        }
    }
    report(verdict, given, off, settled);
    return verdict;
}

// --- 10: a map for each direction ---

/// What chapter 10's map from one direction says about points of the ground.
class SkyTest {
 public:
    SkyTest(const Scene& scene, const glm::dvec3& toSky, int mapSize, DepthFormat format, const SkyBias& bias)
        : frustum_(skyFrustum(boundingSphere(scene), toSky)),
          errors_(depthErrors(format, frustum_, scene.bounds, 3 * transformOperations)),
          map_(scene, frustum_, mapSize, depthErrors(format, frustum_, scene.bounds, transformOperations)),
          textureFromWorld_(frustum_.textureFromWorld()),
          toSky_(toSky),
          mapSize_(mapSize),
          bias_(bias) {}

    /// `n`: of the ground, which a shader knows to `unsure`; `metres` that `p` may be beside its place.
    void add(Open& sum, const glm::dvec3& p, const glm::dvec3& n, double unsure, double metres) const {
        const double weight = glm::dot(n, toSky_);
        if (weight <= horizonCosine - 1e-5) return;
        if (weight <= horizonCosine + 1e-5) {  // rounding decides whether it counts
            sum.unknown += weight, sum.all += weight;
            return;
        }
        sum.all += weight;
        const glm::dvec3 str(textureFromWorld_ * glm::dvec4(p, 1.0));
        const double texelsPerMetre = mapSize_ / (2.0 * frustum_.halfExtent.x);
        const double beside = mapSize_ * double(errors_.rounding.x) + texelsPerMetre * metres;
        const glm::dvec2 slope = depthSlope(textureFromWorld_, p, n);
        const double steep = std::abs(slope.x) + std::abs(slope.y);
        // The shader divides by a facing that is off by `unsure`.
        const bool unknown = unsure > 0.05 * weight;
        const double bias = bias_.constant + bias_.perSlope * steep * 1.2;
        const double depth = str.z - 2.0 * bias - steep * beside / mapSize_;
        const glm::ivec2 first(glm::floor(glm::dvec2(str) * double(mapSize_) - beside)),
            last(glm::floor(glm::dvec2(str) * double(mapSize_) + beside));
        bool open = !unknown, blocked = !unknown;
        for (int y = first.y; y <= last.y && (open || blocked); ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const TexelShadow shadow = map_.shadow({x, y});
                open = open && shadow.open;
                blocked = blocked && depth > shadow.dark;
            }
        if (open) sum.open += weight;
        if (!open && !blocked) sum.unknown += weight;
    }

 private:
    LightFrustum frustum_;
    DepthErrors errors_;
    MapOracle map_;
    glm::dmat4 textureFromWorld_;
    glm::dvec3 toSky_;
    int mapSize_;
    SkyBias bias_;
};

std::vector<SkyTest> skyTests(const Scene& scene, int count, int mapSize, DepthFormat format) {
    const std::vector<glm::dvec3> directions = skyDirections(count, "fibonacci", 0);
    std::vector<LightFrustum> frusta;
    for (const glm::dvec3& l : directions) frusta.push_back(skyFrustum(boundingSphere(scene), l));
    const SkyBias bias = skyBias(format, frusta, scene.bounds, mapSize);
    std::vector<SkyTest> tests;
    for (const glm::dvec3& l : directions) tests.emplace_back(scene, l, mapSize, format, bias);
    return tests;
}

Verdict checkMaps(const Case& given) {
    Verdict verdict;
    const LoneSurface surface = shadowedSurface(given);
    if (!seesGroundAlone(surface)) return nothingSeen();
    const int count = std::clamp(given.integer("samples"), 1, 32), mapSize = given.integer("map-size"),
              picture = std::min(given.integer("picture"), mostPixels);
    const std::string named = given.choice("depth-format"), format = named == "32f-reversed" ? "32f" : named;
    ChapterHarness& harness = shown("10", "tests", surface.scene);
    harness.set({{"samples", std::to_string(count)},
                 {"map-size", std::to_string(mapSize)},
                 {"depth-format", format},
                 {"edges", "hard"}});
    const FloatImage A = harness.scalar("ambient", glm::ivec2(picture));
    if (const std::string found = notFinite(A); !found.empty()) verdict.fail(found);
    const std::vector<SkyTest> tests =
        skyTests(surface.scene, count, mapSize, depthFormat(format, harness.capabilities()));
    const glm::dvec3 n = facingNormal(surface);
    const double pixel = glm::length(surface.point(1, 0, picture) - surface.point(0, 0, picture));
    // Slopes and normals come from differences of neighbouring pixels' positions, each of a few roundings.
    const double reach = largestCoordinate(surface.scene.bounds), unsure = 8.0 * 0x1p-24 * reach / pixel;
    const double metres = pixel * pixelsBeside(surface.scene, 0x1p-9, picture, surface.point(0, 0, picture)) +
                          4.0 * 0x1p-24 * reach;
    double off = 0.0, settled = 0.0;
    for (int y = 0; y < picture; ++y) {
        for (int x = 0; x < picture; ++x) {
            Open open;
            for (const SkyTest& test : tests) test.add(open, surface.point(x, y, picture), n, unsure, metres);
            if (!(open.all > 0.0)) continue;
            off = std::max(off, open.off(A.at(x, y), rounding(count)));
            settled += open.unknown == 0.0 && open.open > 0.0 && open.open < open.all;
        }
    }
    report(verdict, given, off, settled);
    return verdict;
}

const std::vector<std::string> axes{"shape",    "light-type", "light-angle", "scale",   "distance", "aside",
                                    "near-far", "picture",    "samples",     "variant", "fov"};

std::vector<std::string> withMaps() {
    std::vector<std::string> all = axes;
    all.insert(all.end(), {"depth-format", "map-size"});
    return all;
}

const AddSubject rays(
    {.name = "sky-rays",
     .claim = "ambient visibility of a pixel (09) is the share of its own rays that a plain test of every "
              "triangle calls open",
     .axes = axes,
     .check = checkRays,
     .share = 0.25});
const AddSubject maps(
    {.name = "sky-tests",
     .claim = "ambient visibility from shadow maps (10) is the share of its directions that exact geometry "
              "calls open, but for those within a texel and twice the bound of an edge",
     .axes = withMaps(),
     .check = checkMaps,
     .share = 0.25});

}  // namespace
}  // namespace penumbra::stress
