// Chapters 03 to 06: a filtered shadow is the share of its own kernel's tests that are lit, each of them
// decided by exact geometry in double.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "chapters/05_jittered_disk/disk_pattern.h"
#include "chapters/06_jitter_texture/jitter_texture.h"
#include "tests/stress/bias_bound.h"
#include "tests/stress/gl_stage.h"
#include "tests/stress/lone_surface.h"
#include "tests/stress/map_oracle.h"

namespace penumbra::stress {
namespace {

constexpr int diskSamples = 8;
constexpr int mostPixels = 32;  ///< of a side: each is decided tap by tap
/// Where light comes in at less than this, nothing is promised to be free of acne: steepestSlope ends there.
const double faint = std::cos(84.9 * radians);

/// Shares of a kernel's weight.
struct Share {
    double lit = 0.0, unknown = 0.0;
};

/// What a map says about one surface point, tap by tap.
class Point {
 public:
    /// `beside`: texels by which float arithmetic may have the point beside its place.
    Point(const MapOracle& map, std::vector<std::optional<TexelShadow>>& known, int mapSize,
          const glm::dvec3& str, const BiasBound& bound, double beside, bool mayHaveAcne)
        : map_(map),
          known_(known),
          mapSize_(mapSize),
          str_(str),
          slope_(bound.slope()),
          beside_(beside),
          mayHaveAcne_(mayHaveAcne) {
        const double away = (std::abs(slope_.x) + std::abs(slope_.y)) * beside / mapSize;
        unsure_ = away;
    }

    glm::dvec2 texels() const { return glm::dvec2(str_) * double(mapSize_); }
    double beside() const { return beside_; }
    /// The bias that the shader takes, at most; and its depth follows the plane.
    void compareWith(double bias, bool follows) { bias_ = bias, follows_ = follows; }

    /// Adds the test of the texel that `at` (texels) falls in: of all that it may fall in. `compared`: where
    /// the plane's depth is taken, in texels; none: at the texel's centre.
    void add(Share& share, double weight, const glm::dvec2& at, double beside,
             const glm::dvec2* compared = nullptr) {
        const glm::ivec2 first(glm::floor(at - beside)), last(glm::floor(at + beside));
        bool lit = true, dark = true;
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const glm::ivec2 texel =
                    glm::clamp(glm::ivec2(x, y), glm::ivec2(0), glm::ivec2(mapSize_ - 1));
                const TexelShadow& shadow = at_(texel);
                const glm::dvec2 there = compared ? *compared : glm::dvec2(texel) + 0.5;
                lit = lit && shadow.open && !mayHaveAcne_;
                // The bias covers what both depths may be off by; what it leaves, it takes away as well.
                dark = dark && depthAt(there) - 2.0 * bias_ - unsure_ > shadow.dark;
            }
        if (lit) share.lit += weight;
        if (!lit && !dark) share.unknown += weight;
    }

 private:
    const TexelShadow& at_(const glm::ivec2& texel) {
        auto& known = known_[std::size_t(texel.y) * std::size_t(mapSize_) + std::size_t(texel.x)];
        if (!known) known = map_.shadow(texel);
        return *known;
    }
    double depthAt(const glm::dvec2& at) const {
        const double z =
            str_.z + (follows_ ? glm::dot(slope_, at / double(mapSize_) - glm::dvec2(str_)) : 0.0);
        return map_.farther(std::clamp(z, 0.0, 1.0));
    }

    const MapOracle& map_;
    std::vector<std::optional<TexelShadow>>& known_;
    int mapSize_;
    glm::dvec3 str_;
    glm::dvec2 slope_;
    double beside_, unsure_ = 0.0, bias_ = 0.0;
    bool mayHaveAcne_, follows_ = false;
};

/// One of the chapters' kernels: how it is drawn, what bias it takes, and which tests it makes.
struct Kernel {
    std::string name;
    int width = 1;        ///< texels, of a square
    double radius = 0.0;  ///< texels, of a disk
    bool follows = false;

    explicit Kernel(const Case& given)
        : name(given.choice("kernel")),
          width(std::clamp(int(given.number("radius")), 1, 15)),
          radius(given.number("radius")),
          follows(given.integer("variant") % 4 < 2) {
        if (name == "point") width = 1;
    }

    std::string chapter() const {
        return name == "point" ? "03" : name == "disk" ? "05" : name == "jitter" ? "06" : "04";
    }
    void set(ChapterHarness& harness) const {
        if (name == "point") return harness.set("method", follows ? "receiver-plane" : "slope");
        harness.set("receiver-plane", follows ? "true" : "false");
        if (chapter() == "04")
            harness.set({{"kernel-width", std::to_string(width)},
                         {"bilinear", name == "blended" ? "true" : "false"}});
        else
            harness.set({{"radius", fmt::format("{}", radius)}, {"samples", std::to_string(diskSamples)}});
    }
    TapReach reach() const {
        const double k = 0.5 * (width - 1);
        TapReach reach{.followsPlane = follows};
        if (chapter() == "04") reach.square = k + (follows && name == "blended" ? 0.5 : 0.0);
        if (!follows && name == "blended") reach.footprint = 0.5;
        if (chapter() > "04") reach.disk = radius;
        if (name == "jitter") reach.footprint = follows ? 0.5 : 0.0;
        return reach;
    }

    /// Of pixel (x, y), y down, of a square picture.
    Share share(Point& point, int x, int y, int picture, int mapSize) const {
        if (name == "blended") return blended(point);
        if (name == "disk") return disk(point);
        if (name == "jitter") return jitter(point, x, picture - 1 - y, mapSize);
        Share share;
        const double k = 0.5 * (width - 1);
        for (int j = 0; j < width; ++j)
            for (int i = 0; i < width; ++i)
                point.add(share, 1.0 / (width * width), point.texels() + glm::dvec2(i - k, j - k),
                          point.beside());
        return share;
    }
    /// What the answer may be off by besides: the sum's own rounding; and what a sampler blends with is in
    /// steps of 1/256, of which only the outermost texels of a row do not cancel.
    double rounding(double beside) const {
        const double sum = 2.0 * 0x1p-24 * double(width * width + diskSamples);
        return name == "blended" ? sum + 2.0 * (1.0 / 256.0 + beside) / width : sum;
    }

 private:
    Share blended(Point& point) const {
        Share share;
        const glm::dvec2 from = point.texels() - 0.5 * width, first = glm::floor(from), f = from - first;
        for (int j = 0; j <= width; ++j)
            for (int i = 0; i <= width; ++i) {
                const glm::dvec2 ij(i, j);
                const glm::dvec2 weight =
                    glm::clamp(glm::min(ij + 1.0 - f, double(width) - ij + f), 0.0, 1.0);
                point.add(share, weight.x * weight.y / (width * width), first + ij + 0.5, 0.0);
            }
        return share;
    }
    Share disk(Point& point) const {
        static const std::vector<glm::dvec2> pattern =
            diskPattern(SquarePattern::jittered, DiskMap::concentric, diskSamples, 0);
        Share share;
        for (const glm::dvec2& p : pattern)
            point.add(share, 1.0 / diskSamples, point.texels() + radius * p,
                      point.beside() + 0x1p-22 * radius);
        return share;
    }
    Share jitter(Point& point, int x, int y, int mapSize) const {
        constexpr int tile = 16;
        static const JitterTile pattern(tile, diskSamples, JitterOrder::blue, 0);
        Share share;
        for (const glm::vec2& p : pattern.column(x % tile, y % tile)) {
            const glm::dvec2 step(quantized(p.x, 8), quantized(p.y, 8));
            const glm::dvec2 at = glm::clamp(point.texels() + radius / 127.0 * step, 0.5, mapSize - 0.5);
            point.add(share, 1.0 / diskSamples, at, point.beside() + 0x1p-22 * radius, &at);
        }
        return share;
    }
};

Verdict check(const Case& given) {
    Verdict verdict;
    const LoneSurface surface = shadowedSurface(given);
    if (!seesGroundAlone(surface)) return nothingSeen();
    const Kernel kernel(given);
    const std::string format = given.choice("depth-format");
    const int mapSize = given.integer("map-size"), picture = std::min(given.integer("picture"), mostPixels);
    const std::string kept = kernel.chapter() == "06" ? given.choice("light-type") + format : "";
    ChapterHarness& harness = shown(kernel.chapter(), kept, surface.scene);
    harness.set({{"depth-format", format},
                 {"map-size", std::to_string(mapSize)},
                 {"fit", surface.fitToView ? "view" : "scene"},
                 {"bias", "1"}});
    kernel.set(harness);
    const FloatImage visibility = harness.scalar("visibility", glm::ivec2(picture));
    if (const std::string found = notFinite(visibility); !found.empty()) verdict.fail(found);

    const LightFrustum frustum = surface.frustum(format);
    const DepthFormat bits = depthFormat(format, harness.capabilities());
    const DepthErrors both = depthErrors(bits, frustum, surface.scene.bounds, 3 * transformOperations);
    const MapOracle map(surface.scene, frustum, mapSize,
                        depthErrors(bits, frustum, surface.scene.bounds, transformOperations));
    std::vector<std::optional<TexelShadow>> known(std::size_t(mapSize) * std::size_t(mapSize));
    const glm::dmat4 m = frustum.textureFromWorld();
    const auto strqOf = [&](const glm::dvec3& p) { return m * glm::dvec4(p, 1.0); };
    const glm::dvec3 corner = surface.point(0, 0, picture);
    const glm::dvec4 dx = m * glm::dvec4(surface.point(1, 0, picture) - corner, 0.0),
                     dy = m * glm::dvec4(surface.point(0, 1, picture) - corner, 0.0);
    const double shift = pixelsBeside(surface.scene, both.snap, picture, corner);
    double off = 0.0, settled = 0.0;
    for (int y = 0; y < picture; ++y) {
        for (int x = 0; x < picture; ++x) {
            const glm::dvec3 p = surface.point(x, y, picture);
            const glm::dvec4 strq = strqOf(p);
            if (surface.behindSpot(p) || !(strq.w > 0.0)) continue;
            const glm::dvec3 str = glm::dvec3(strq) / strq.w;
            const BiasBound bound(frustum, both, mapSize, strq, dx, dy);
            const glm::dvec2 a = (glm::dvec2(dx) - glm::dvec2(str) * dx.w) / strq.w,
                             b = (glm::dvec2(dy) - glm::dvec2(str) * dy.w) / strq.w;
            const glm::dvec2 step = double(mapSize) * (glm::abs(a) + glm::abs(b));
            const double beside = bound.sideways() + shift * std::max(step.x, step.y);
            // Off the map, or so near to its border that rounding decides: chapter 02's decree, not a test.
            const double margin = beside / mapSize;
            if (!(std::min({str.x, str.y, 1.0 - str.x, 1.0 - str.y}) > margin) || std::abs(str.z - 0.5) > 0.5)
                continue;
            Point point(map, known, mapSize, str, bound, beside, surface.cosine(p) < faint);
            point.compareWith(bound.bias(kernel.reach()), kernel.follows);
            const Share share = kernel.share(point, x, y, picture, mapSize);
            const double V = visibility.at(x, y), tolerance = kernel.rounding(beside);
            off = std::max(off, std::max(share.lit - V, V - share.lit - share.unknown) / tolerance);
            settled += share.unknown == 0.0 && share.lit > 0.01 && share.lit < 0.99;
        }
    }
    if (promised(given))
        verdict.expectAtMost("visibility beside the share of tests, over its rounding", off, 1.0);
    verdict.measure("pixels in half-shadow of which every test is known", settled);
    return verdict;
}

const AddSubject kernel(
    {.name = "kernel",
     .claim = "a filtered shadow (03 to 06) is the share of its kernel's tests that exact geometry calls lit",
     .axes = {"kernel", "radius", "shape", "light-type", "depth-format", "light-angle", "scale", "distance",
              "aside", "fov", "map-size", "near-far", "picture", "variant"},
     .check = check,
     .share = 0.6});

}  // namespace
}  // namespace penumbra::stress
