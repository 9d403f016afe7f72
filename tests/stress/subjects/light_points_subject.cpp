// Chapter 08: the share of an area light that a texel of a receiver sees is that of its light points, each of
// them decided by exact geometry; between texels it is blended; and light is that share of Lambert's.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "chapters/08_accumulation/light_points.h"
#include "chapters/08_accumulation/projection.h"
#include "chapters/08_accumulation/reach.h"
#include "tests/image/lit_scenes.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/lone_surface.h"
#include "tests/stress/projected_triangle.h"
#include "tests/stress/receiver_texels.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

constexpr int mostPixels = 24;
constexpr double lightDistance = 3.0;
constexpr double mostTexelsBeside = 4.0;

/// shadowedSurface under a square light in the place of its light.
LoneSurface underAreaLight(const Case& given) {
    Case underPoint = given;  // in the middle of the area light
    underPoint.values["light-type"] = axisNamed("light-type").parse("point");
    underPoint.values["fov"] = axisNamed("fov").simplest;
    LoneSurface surface = shadowedSurface(underPoint);
    const Light light = surface.scene.lights[0];
    surface.scene.lights.clear();
    const double metre = given.number("scale");
    const double side = lightDistance * metre * std::min(given.number("light-size"), 10.0);
    surface.scene =
        withAreaLight(std::move(surface.scene), squareLight(light.position, light.direction, side));
    return surface;
}

/// Shares of the light that a texel sees: surely, and at most.
struct Seen {
    double least = 0.0, most = 1.0;
};

/// One light point: the triangles as its matrix projects them on the receiver's texture, where q is the
/// fraction of the way from the light.
struct ProjectedLight {
    LightPoint point;
    double height;
    double near, far;  ///< q: only what lies between is surely not cut off
    bool tooLow;
    std::vector<ProjectedTriangle> triangles;
};

class LightOnReceiver {
 public:
    LightOnReceiver(const Scene& scene, const Receiver& receiver, const std::vector<LightPoint>& points)
        : receiver_(receiver), light_(scene.lights[0]) {
        const Occluders between = occludersBetween(scene, receiver, light_);
        const std::vector<Triangle> all = trianglesIn(scene);
        const glm::dvec3 largest = glm::max(glm::abs(scene.bounds.lower), glm::abs(scene.bounds.upper));
        const double snap = halfSubpixel();
        for (const LightPoint& point : points) {
            const auto projection = projectOnReceiver(receiver, point, between.near, between.highest);
            if (!projection) continue;
            const glm::dmat4& m = projection->textureFromWorld;
            glm::dvec4 sizes = glm::abs(m[3]);
            for (int i = 0; i < 3; ++i) sizes += glm::abs(m[i]) * largest[i];
            // The rows of clipFromWorld are 2u - t and 2v - t: twice the roundings.
            const glm::dvec4 rounding = 2.0 * transformOperations * 0x1p-24 * sizes;
            const DrawnOff off{
                snap, {std::max(rounding.x, rounding.y) + rounding.w, 0.0, rounding.w}, projection->near};
            // The planes that cut: z + w = 2 far (t - near) / (far - near) and w - z = 2 near (far - t) /
            // (far - near). z's row is t's, stretched, and a constant: both together are off by 2 far (offT +
            // offOne near) / (far - near). So far aside near is sharp, but far is not: dividing by a small
            // near multiplies what t is off by.
            const double offOne = transformOperations * 0x1p-24, offT = offOne * sizes.w;
            const double nearOff = offT + offOne,
                         farOff = (offT / projection->near + offOne) * projection->far;
            ProjectedLight light{point,
                                 receiver.height(point.position),
                                 projection->near + nearOff,
                                 std::max(projection->far - farOff, projection->near),
                                 projection->tooLow,
                                 {}};
            for (std::size_t t = 1; t < all.size(); ++t)
                light.triangles.emplace_back(m, glm::dvec2(receiver.texels), all[t], off);
            lights_.push_back(std::move(light));
        }
    }

    const Seen& seen(const glm::ivec2& texel) {
        const auto [at, isNew] = known_.try_emplace(texel.y * receiver_.texels.x + texel.x);
        if (isNew) at->second = decide(texel);
        return at->second;
    }

 private:
    Seen decide(const glm::ivec2& texel) const {
        const glm::dvec3 x = receiver_.texelCentre(texel.x, texel.y);
        const double inFront = glm::dot(light_.direction, x - light_.position);
        const double unsure = 0x1p-20 * (glm::length(light_.position) + glm::length(receiver_.corner) +
                                         glm::length(receiver_.uEdge) + glm::length(receiver_.vEdge));
        if (inFront < -unsure) return {0.0, 0.0};
        double all = 0.0, lit = 0.0, unknown = 0.0;
        for (const ProjectedLight& light : lights_) {
            const glm::dvec3 d = light.point.position - x;
            const double weight = light.point.weight * light.height / std::pow(glm::dot(d, d), 2.0);
            const Cover hidden = covered(light, glm::dvec2(texel) + 0.5);
            all += weight;
            lit += hidden == Cover::no ? weight : 0.0;
            unknown += hidden == Cover::maybe ? weight : 0.0;
        }
        if (!(all > 0.0)) return {0.0, lights_.empty() ? 0.0 : 1.0};
        return {inFront < unsure ? 0.0 : lit / all, (lit + unknown) / all};
    }
    static Cover covered(const ProjectedLight& light, const glm::dvec2& at) {
        Cover most = Cover::no;
        for (const ProjectedTriangle& triangle : light.triangles) {
            Cover cover = triangle.covers(at);
            if (cover == Cover::no) continue;
            // What lies nearer to the receiver than float arithmetic can tell from it is cut off, and so is
            // what lies nearer to the light than a thousandth of the way. The corners of the cut are moved
            // like all others; 1/q is linear in the texture.
            const double inverse = 1.0 / triangle.distance(at), m = triangle.margin();
            double change = 0.0;
            for (const glm::dvec2& moved : {glm::dvec2(m, m), glm::dvec2(m, -m)})
                change = std::max(change, std::abs(1.0 / triangle.distance(at + moved) - inverse));
            if (light.tooLow || inverse - change < 1.0 / light.far || inverse + change > 1.0 / light.near)
                cover = Cover::maybe;
            if (cover == Cover::yes) return cover;
            most = Cover::maybe;
        }
        return most;
    }

    const Receiver& receiver_;
    const Light& light_;
    std::vector<ProjectedLight> lights_;
    std::map<int, Seen> known_;
};

struct Off {
    double visibility = 0.0, irradiance = 0.0, gained = 0.0, settled = 0.0;
};

double outside(double value, double least, double most, double tolerance) {
    return std::max(least - value, value - most) / tolerance;
}

/// Pixel by pixel, each of the four texels that it is blended from.
Off compare(const LoneSurface& surface, const Receiver& receiver, const std::vector<LightPoint>& points,
            const FloatImage& V, const FloatImage& E) {
    LightOnReceiver light(surface.scene, receiver, points);
    const Light& area = surface.scene.lights[0];
    std::map<int, double> known;
    const auto whole = [&](const glm::ivec2& t) {
        const auto [at, isNew] = known.try_emplace(t.y * receiver.texels.x + t.x);
        if (isNew) at->second = area.emission.x * unoccluded(receiver, area, t);
        return at->second;
    };
    const auto least = [&](const glm::ivec2& t) { return light.seen(t).least; };
    const auto most = [&](const glm::ivec2& t) { return light.seen(t).most; };
    // Sums of float weights, each of a dozen roundings; the blend; and the texture that is interpolated
    // (2e-8).
    const double rounding = (double(points.size()) + 32.0) * 0x1p-23;
    const double shift = pixelsBeside(surface.scene, halfSubpixel(), V.width, surface.point(0, 0, V.width));
    const double pixel = glm::length(surface.point(1, 0, V.width) - surface.point(0, 0, V.width));
    const double texelsPerMetre = std::max(receiver.texels.x / glm::length(receiver.uEdge),
                                           receiver.texels.y / glm::length(receiver.vEdge));
    Off off;
    for (int y = 0; y < V.height; ++y) {
        for (int x = 0; x < V.width; ++x) {
            const glm::dvec3 p = surface.point(x, y, V.width);
            // More than a texel only so far aside that nothing is promised.
            const double beside = std::min(2.0 * (texelsBeside(receiver, p) + shift * pixel * texelsPerMetre),
                                           mostTexelsBeside);
            const auto within = [&](const auto& value) { return blendedWithin(receiver, p, beside, value); };
            const double low = within(least).least, high = within(most).most;
            off.visibility = std::max(off.visibility, outside(V.at(x, y), low, high, rounding));
            const TexelBlend blend(receiver, p);
            const double darkest = blend.of(least);
            off.settled += darkest == blend.of(most) && darkest > 0.0 && darkest < 1.0;
            const double full = within(whole).most, slackE = rounding * std::max(full, 1e-30);
            const double lowE = within([&](const glm::ivec2&t) { return least(t) * whole(t); }).least,
                         highE = within([&](const glm::ivec2&t) { return most(t) * whole(t); }).most;
            off.irradiance = std::max(off.irradiance, outside(E.at(x, y, 0), lowE, highE, slackE));
            off.gained = std::max(off.gained, (E.at(x, y, 0) - full) / slackE);
        }
    }
    return off;
}

Verdict check(const Case& given) {
    Verdict verdict;
    const LoneSurface surface = underAreaLight(given);
    if (!seesGroundAlone(surface)) return nothingSeen();
    const glm::dvec3 n = surface.normal();
    const std::vector<Receiver> receivers =
        receiversOf(surface.scene, 0, 1e-4, glm::dot(n, surface.scene.cameras[0].forward) > 0.0 ? -n : n);
    if (receivers.size() != 1) return verdict;
    const int variant = given.integer("variant"), count = std::clamp(given.integer("samples"), 1, 48),
              picture = std::min(given.integer("picture"), mostPixels);
    const std::vector<std::string> patterns{"regular", "jittered", "fibonacci", "owen-sobol"};
    const auto pattern = std::size_t(variant) % 4;
    ChapterHarness& harness = shown("08", "points", surface.scene);
    harness.set({{"method", variant % 8 < 4 ? "mask" : "accumulate"},
                 {"target", "32f"},
                 {"pattern", patterns[pattern]},
                 {"samples", std::to_string(count)},
                 {"others-samples", "1"},
                 {"texel-budget", "4"},
                 {"minimum-area", "0.0001"}});
    const FloatImage V = harness.picture("visibility", glm::ivec2(picture), 3),
                     E = harness.picture("irradiance", glm::ivec2(picture), 3);
    for (const FloatImage* image : {&V, &E})
        if (const std::string found = notFinite(*image); !found.empty()) verdict.fail(found);
    const std::vector<LightPoint> points =
        lightPoints(surface.scene.lights[0], count, LightPattern(pattern), 0);
    const Off off = compare(surface, receivers[0], points, V, E);
    if (promised(given)) {
        verdict.expectAtMost("visibility beside that of its light points, over its rounding", off.visibility,
                             1.0);
        verdict.expectAtMost("irradiance beside that of its light points, over its rounding", off.irradiance,
                             1.0);
        verdict.expectAtMost("light beyond what arrives with nothing in between, over its rounding",
                             off.gained, 1.0);
    }
    verdict.measure("pixels in half-shadow of which every light point is known", off.settled);
    return verdict;
}

const AddSubject lightPointsSubject(
    {.name = "light-points",
     .claim =
         "what a texel of a receiver sees of an area light (08) is the share of its light points that exact "
         "geometry calls visible, and its light that share of Lambert's formula",
     .axes = {"shape", "light-angle", "light-size", "scale", "distance", "aside", "near-far", "picture",
              "samples", "variant"},
     .check = check,
     .share = 0.25});

}  // namespace
}  // namespace penumbra::stress
