// Irradiance of a sky without occluders: convolved, in a map, and by spherical harmonics.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "chapters/11_bent_normals/irradiance_map.h"
#include "chapters/11_bent_normals/sh_irradiance.h"
#include "chapters/11_bent_normals/sky_samples.h"
#include "tests/stress/case.h"
#include "tests/stress/dice.h"

namespace penumbra::stress {
namespace {

constexpr int bands = 8, columns = 32;

double least(const glm::dvec3& v) {
    return std::min({v.x, v.y, v.z});
}
double most(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// A lamp of the case's size and angle from the zenith, in a sky that may be black.
Radiance lampIn(const Case& given, Dice& dice) {
    const double angle = given.number("light-angle") * std::numbers::pi / 180.0, turn = 7.0 * dice.unit();
    const glm::dvec3 lamp(std::sin(angle) * std::cos(turn), std::cos(angle),
                          std::sin(angle) * std::sin(turn));
    const double cosine = std::cos(std::min(3.0, given.number("light-size")));
    const double bright = given.number("scale"),
                 dark = dice.oneIn(2) ? 0.0 : bright * dice.magnitude(1e-9, 1.0);
    return [=](const glm::dvec3& w) {
        return glm::dvec3(glm::dot(w, lamp) >= cosine ? bright : dark, dark, bright);
    };
}

/// Poles, seams, the horizon, a bit beside these, and anywhere.
glm::dvec3 direction(Dice& dice) {
    glm::dvec3 n(0.0);
    n[dice.below(3)] = dice.oneIn(2) ? 1.0 : -1.0;
    switch (dice.below(4)) {
        case 0:
            return dice.oneIn(2) ? n : -n;
        case 1:
            return glm::normalize(n + dice.magnitude(1e-300, 1e-3) * dice.inCube());
        case 2:
            return glm::normalize(glm::dvec3(dice.between(-1.0, 1.0), 0.0, dice.magnitude(1e-17, 1.0)));
        default:
            return dice.direction();
    }
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(std::uint64_t(given.integer("variant")));
    const SkySamples samples = sampleSky(lampIn(given, dice), bands, columns);
    const CosineConvolution sky(samples);
    const IrradianceMap map = convolveSky(sky, 2);
    const ShIrradiance harmonics = ShIrradiance::of(samples);
    const double bright = given.number("scale"), peak = std::numbers::pi * bright;
    double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
    for (const float v : map.texels.values)
        lowest = std::min(lowest, double(v)), highest = std::max(highest, double(v));
    for (int i = 0; i < 32; ++i) {
        const glm::dvec3 n = direction(dice), exact = sky.irradiance(n), looked = map.at(n),
                         smooth = harmonics.at(n);
        verdict.expectAtMost("irradiance below 0, relative", -least(exact) / bright, 0.0);
        // The horizon cuts through a ring of `columns` points: like a midpoint rule of so many steps.
        constexpr double step = 2.0 * std::numbers::pi / columns;
        verdict.expectAtMost(
            "irradiance beyond that of a sky as bright everywhere, over the quadrature's error",
            (most(exact) / peak - 1.0) / (step * step / 12.0), 1.0);
        verdict.expectAtMost("groups of samples, relative difference",
                             glm::length(exact - sky.irradianceOneByOne(n)) / peak, 1e-13);
        // The four weights of a look-up sum to 1 but for their rounding.
        verdict.expectAtMost("looked up outside of what is in the map, relative",
                             std::max(lowest - least(looked), most(looked) - highest) / peak, 4e-16);
        verdict.expectAtMost("harmonics below 0, relative", -least(smooth) / bright, 0.0);
        // 9.4 % of a lamp's peak, which is at most the sky's.
        verdict.expectAtMost("harmonics off, relative to the sky's peak",
                             most(glm::abs(smooth - exact)) / peak, 0.1);
    }
    return verdict;
}

const AddSubject irradiance(
    {.name = "irradiance",
     .claim = "irradiance of a sky is finite, not negative and no more than the sky gives, in "
              "every direction and form",
     .axes = {"light-angle", "light-size", "scale", "variant"},
     .check = check,
     .share = 0.3});

}  // namespace
}  // namespace penumbra::stress
