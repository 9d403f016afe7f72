// Chapter 11: what a sky gives to a plane, as nine numbers, as a picture, and as a linear function, against
// integrals that are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "chapters/09_ambient_occlusion/sky.h"
#include "chapters/11_bent_normals/irradiance_map.h"
#include "chapters/11_bent_normals/irradiance_truth.h"
#include "chapters/11_bent_normals/sh_irradiance.h"
#include "common/math/hemisphere.h"
#include "common/math/sampling.h"

namespace penumbra {
namespace {

using glm::dvec3;
using std::numbers::pi;

const std::string assets = std::string(PENUMBRA_SOURCE_DIR) + "/assets/";

SkySamples samplesOf(const Sky& sky) {
    return sampleSky([&](const dvec3& w) { return sky.radiance(w); });
}

/// One lamp, far away and small, that gives `power` to a plane facing it.
SkySamples lamp(const dvec3& direction, const dvec3& power) {
    return {1, 1, {{direction, power}}};
}

double relativeDistance(const dvec3& a, const dvec3& b) {
    return glm::length(a - b) / glm::length(b);
}

/// Integral of f over x in [a, b], Gauss with five points: exact up to degree 9.
template <class F>
auto gauss(double a, double b, const F& f) {
    constexpr std::array<double, 5> at = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                          -0.9061798459386640};
    constexpr std::array<double, 5> weight = {128.0 / 225.0, 0.4786286704993665, 0.4786286704993665,
                                              0.2369268850561891, 0.2369268850561891};
    auto sum = 0.0 * f(a);
    for (std::size_t i = 0; i < at.size(); ++i)
        sum += 0.5 * (b - a) * weight[i] * f(0.5 * (a + b) + 0.5 * (b - a) * at[i]);
    return sum;
}

/// int L(w) (n.w) dw over the hemisphere about n; exact for polynomial skies of order 2: of degree 3 in
/// height, of degree 2 round the axis.
dvec3 hemisphereIntegral(const Radiance& radiance, const dvec3& n) {
    const glm::dmat3 frame = frameAround(n);
    return gauss(0.0, 1.0, [&](double z) {
        dvec3 ring(0.0);
        for (int i = 0; i < 8; ++i) {
            const double phi = 2.0 * pi * i / 8.0, r = std::sqrt(1.0 - z * z);
            ring += 2.0 * pi / 8.0 * z * radiance(frame * dvec3(r * std::cos(phi), r * std::sin(phi), z));
        }
        return ring;
    });
}

// --- the quadrature ----------------------------------------------------------------------------------------

TEST(SkySamples, CoverTheSphereOnce) {
    const SkySamples sky = sampleSky([](const dvec3&) { return dvec3(1.0); });
    ASSERT_EQ(sky.samples.size(), std::size_t(sky.rows) * std::size_t(sky.columns));
    double total = 0.0;
    dvec3 first(0.0);
    glm::dmat3 second(0.0);
    for (const SkySample& s : sky.samples) {
        ASSERT_NEAR(glm::length(s.direction), 1.0, 1e-12);
        total += s.power.r;
        first += s.power.r * s.direction;
        second += s.power.r * glm::outerProduct(s.direction, s.direction);
    }
    EXPECT_NEAR(total, 4.0 * pi, 1e-9);
    EXPECT_LE(glm::length(first), 1e-9);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(second[i][j], i == j ? 4.0 * pi / 3.0 : 0.0, 1e-8);
}

TEST(SkySamples, LongitudesAreThoseOfALatLongPicture) {
    EXPECT_LE(glm::distance(skyDirection(0.0, 0.0), dvec3(0, 0, -1)), 1e-15);
    EXPECT_LE(glm::distance(skyDirection(0.0, 0.5 * pi), dvec3(1, 0, 0)), 1e-15);
    EXPECT_LE(glm::distance(skyDirection(1.0, 2.0), dvec3(0, 1, 0)), 1e-15);
    FloatImage picture(4, 1, 3);  // the column left of the middle and its neighbour: -z is in between
    for (int c = 0; c < 3; ++c) picture.at(1, 0, c) = picture.at(2, 0, c) = 1.0f;
    const Sky sky = Sky::latLong(picture);
    EXPECT_NEAR(sky.radiance(skyDirection(0.0, 0.0)).r, 1.0, 1e-12);
    EXPECT_NEAR(sky.radiance(skyDirection(0.0, 0.25 * pi)).r, 1.0, 1e-12);  // the centre of column 2
    EXPECT_NEAR(sky.radiance(skyDirection(0.0, pi)).r, 0.0, 1e-12);
}

// --- spherical harmonics -----------------------------------------------------------------------------------

TEST(ShIrradiance, IsExactForASkyOfOrderTwo) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int trial = 0; trial < 3; ++trial) {
        std::array<dvec3, 9> coefficients;
        for (dvec3& c : coefficients) c = {number(random), number(random), number(random)};
        coefficients[0] += dvec3(8.0);  // bright enough never to be clamped
        const auto radiance = [&](const dvec3& w) {
            dvec3 sum(0.0);
            for (std::size_t i = 0; i < 9; ++i) sum += sphericalHarmonics(w)[i] * coefficients[i];
            return sum;
        };
        const ShIrradiance sh = ShIrradiance::of(sampleSky(radiance));
        for (int i = 0; i < 200; ++i) {
            const dvec3 n = fibonacciSphere(i, 200);
            ASSERT_LE(glm::distance(sh.at(n), hemisphereIntegral(radiance, n)), 1e-6);
        }
    }
}

// A lamp at one point is as far from order 2 as a sky can be: its clamped cosine less the first three orders
// has its maximum, 3/32 of the peak, where the lamp rises.
TEST(ShIrradiance, ErrsByAsMuchAsTheoryAllowsForOneLamp) {
    const dvec3 l = glm::normalize(dvec3(0.3, 0.8, -0.5));
    const ShIrradiance sh = ShIrradiance::of(lamp(l, dvec3(1.0)));
    double worst = 0.0, squares = 0.0;
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
        const dvec3 n = fibonacciSphere(i, count);
        double unclamped = 0.0;
        for (std::size_t k = 0; k < 9; ++k) unclamped += sphericalHarmonics(n)[k] * sh.coefficients[k].r;
        const double error = unclamped - std::max(0.0, glm::dot(n, l));
        worst = std::max(worst, std::abs(error));
        squares += error * error;
        ASSERT_GE(sh.at(n).r, 0.0);
    }
    EXPECT_NEAR(worst, 0.09375, 1e-4);
    EXPECT_NEAR(std::sqrt(squares / count), 0.036, 0.001);
}

TEST(ShIrradiance, IsNeverNegative) {
    // Two lamps opposite each other leave a belt of darkness that order 2 overshoots below zero.
    SkySamples lamps{1, 2, {{dvec3(0, 1, 0), dvec3(1.0)}, {dvec3(0, -1, 0), dvec3(1.0)}}};
    lamps.samples[1].power = dvec3(-0.7);
    const ShIrradiance sh = ShIrradiance::of(lamps);
    double least = 1.0;
    for (int i = 0; i < 500; ++i) least = std::min(least, sh.at(fibonacciSphere(i, 500)).r);
    EXPECT_EQ(least, 0.0);
}

TEST(ShIrradiance, OfAnOvercastSkyIsWithinAPercent) {
    const SkySamples samples = samplesOf(Sky::overcast(dvec3(1.0)));
    const ShIrradiance sh = ShIrradiance::of(samples);
    const CosineConvolution convolution(samples);
    double error = 0.0, mean = 0.0;
    for (int i = 0; i < 500; ++i) {
        const dvec3 n = fibonacciSphere(i, 500), exact = convolution.irradiance(n);
        error += std::abs(sh.at(n).r - exact.r);
        mean += exact.r;
    }
    EXPECT_LE(error / mean, 0.01);
}

// --- the convolution and its picture -----------------------------------------------------------------------

TEST(CosineConvolution, HasTheKnownIntegrals) {
    const CosineConvolution uniform(samplesOf(Sky::uniform(dvec3(1.0, 2.0, 3.0))));
    const CosineConvolution overcast(samplesOf(Sky::overcast(dvec3(1.0))));
    for (const dvec3& n : {dvec3(0, 1, 0), dvec3(0, -1, 0), glm::normalize(dvec3(1, 2, -3))})
        EXPECT_LE(relativeDistance(uniform.irradiance(n), pi * dvec3(1.0, 2.0, 3.0)), 2e-6);
    EXPECT_NEAR(overcast.irradiance({0, 1, 0}).r, 7.0 * pi / 9.0, 1e-6);
    EXPECT_NEAR(overcast.irradiance({1, 0, 0}).r, pi / 6.0 + 4.0 / 9.0, 1e-5);
    EXPECT_NEAR(overcast.irradiance({0, -1, 0}).r, 0.0, 1e-12);
}

TEST(CosineConvolution, GroupsAreExact) {
    for (const SkySamples& samples :
         {samplesOf(Sky::named(assets + "clear_sky.hdr")),
          sampleSky([](const dvec3& w) { return dvec3(w.x > 0.9, 1.0, w.y > 0.0); }, 37, 75)}) {
        const CosineConvolution convolution(samples);
        for (int i = 0; i < 20; ++i) {
            const dvec3 n = fibonacciSphere(i, 20);
            EXPECT_LE(relativeDistance(convolution.irradiance(n), convolution.irradianceOneByOne(n)), 1e-12);
        }
    }
}

TEST(IrradianceMap, IsAsSmallAsItsErrorAllows) {
    for (const char* name : {"uniform", "overcast", "clear_sky.hdr"}) {
        const bool file = std::string(name).ends_with(".hdr");
        const CosineConvolution sky(samplesOf(Sky::named(file ? assets + name : name)));
        const IrradianceMap map = smallestIrradianceMap(sky, 2e-3);
        EXPECT_LE(map.rmse, 2e-3) << name;
        EXPECT_LE(map.worst, 0.02) << name;
        EXPECT_EQ(map.texels.width, 2 * (map.texels.height - 1));
        if (map.texels.height > 5) {  // a level less is not enough
            EXPECT_GT(convolveSky(sky, int(std::log2(map.texels.height - 1)) - 1).rmse, 2e-3) << name;
        }
    }
}

TEST(IrradianceMap, IsExactAtItsTexelsAndHasNoSeam) {
    const CosineConvolution sky(samplesOf(Sky::named(assets + "clear_sky.hdr")));
    const IrradianceMap map = convolveSky(sky, 4);
    for (int row = 0; row < map.texels.height; ++row) {
        const dvec3 n = skyDirection(std::cos(pi * row / 16.0), 2.0 * pi * 7.0 / 32.0);
        EXPECT_LE(relativeDistance(map.at(n), sky.irradiance(n)), 1e-6) << row;
    }
    for (const double y : {-0.9, 0.0, 0.4}) {
        const dvec3 left = map.at(skyDirection(y, -1e-7)), right = map.at(skyDirection(y, 1e-7));
        EXPECT_LE(relativeDistance(left, right), 1e-6);
    }
    EXPECT_EQ(map.at({0, 1, 0}), map.at({-0.0, 1, 0.0}));
    EXPECT_LE(relativeDistance(map.at(skyDirection(1.0 - 1e-14, 2.0)), map.at({0, 1, 0})), 1e-6);
}

// --- rays where the sky is bright --------------------------------------------------------------------------

TEST(SkyDensity, IsADensity) {
    const SkyDensity density(samplesOf(Sky::named(assets + "clear_sky.hdr")));
    double total = 0.0;
    for (const SkySample& s : sampleSky([&](const dvec3& w) { return dvec3(density.at(w)); }).samples)
        total += s.power.r;
    EXPECT_NEAR(total, 1.0, 1e-9);
}

TEST(SkyDensity, FindsAllOfTheLight) {
    for (const char* name : {"clear_sky.hdr", "chapel.hdr"}) {
        const Sky sky = Sky::named(assets + name);
        const SkySamples samples = samplesOf(sky);
        const SkyDensity density(samples);
        dvec3 exact(0.0), estimate(0.0);
        for (const SkySample& s : samples.samples) exact += s.power;
        constexpr int count = 4096;
        for (int i = 0; i < count; ++i) {
            const dvec3 w = density.direction(owenSobol(std::uint32_t(i), 7));
            ASSERT_NEAR(glm::length(w), 1.0, 1e-12);
            estimate += sky.radiance(w) / (density.at(w) * count);
        }
        EXPECT_LE(relativeDistance(estimate, exact), 0.003) << name;
    }
}

TEST(SkyDensity, OfABlackSkyIsNone) {
    EXPECT_TRUE(SkyDensity(samplesOf(Sky::uniform(dvec3(0.0)))).isBlack());
}

/// A triangle with nothing around it, and a point in its middle.
struct OpenPlane {
    Scene scene;
    Hit hit;

    explicit OpenPlane(const dvec3& n) {
        const glm::dmat3 frame = frameAround(n);
        for (const dvec3& corner : {dvec3(-1, -1, 0), dvec3(1, -1, 0), dvec3(0, 1, 0)}) {
            scene.positions.emplace_back(frame * corner);
            scene.normals.emplace_back(n);
            scene.uvs.emplace_back(0.0f);
            scene.indices.push_back(std::uint32_t(scene.indices.size()));
            scene.bounds.extend(dvec3(scene.positions.back()));
        }
        scene.parts.push_back({"triangle", 0, 1, 0, scene.bounds, false});
        scene.clusters.push_back({0, 1, 0, scene.bounds});
        scene.materials.emplace_back();
        hit.valid = true;
        hit.geometricNormal = hit.shadingNormal = n;
    }
};

TEST(TracedIrradiance, IsTheConvolutionInTheOpen) {
    for (const char* name : {"overcast", "clear_sky.hdr"}) {
        const bool file = std::string(name).ends_with(".hdr");
        const Sky sky = Sky::named(file ? assets + name : name);
        const SkySamples samples = samplesOf(sky);
        const SkyDensity density(samples);
        const CosineConvolution convolution(samples);
        for (const dvec3& n : {dvec3(0, 1, 0), glm::normalize(dvec3(1, 0.2, 0.3))}) {
            const OpenPlane plane(n);
            const RayTracer tracer(plane.scene);
            dvec3 sum(0.0);
            double squares = 0.0;
            constexpr int trials = 32;
            for (std::uint32_t seed = 0; seed < trials; ++seed) {
                const dvec3 E = tracedIrradiance(tracer, plane.hit, sky, density, 512, seed);
                sum += E / double(trials);
                squares += E.g * E.g;
            }
            const double deviation = std::sqrt(std::max(0.0, squares / trials - sum.g * sum.g));
            const double exact = convolution.irradiance(n).g;
            // By the cosine alone a sun of 5 degrees is hit by one ray of the 512: 100 % of its light.
            EXPECT_LE(deviation, 0.02 * exact) << name;
            EXPECT_NEAR(sum.g, exact, 3.0 * deviation / std::sqrt(trials) + 2e-5 * exact) << name;
        }
    }
}

TEST(TracedIrradiance, NothingComesFromABlackSkyAndNothingIsNoNumber) {
    const OpenPlane plane({0, 1, 0});
    const RayTracer tracer(plane.scene);
    const Sky black = Sky::uniform(dvec3(0.0));
    EXPECT_EQ(tracedIrradiance(tracer, plane.hit, black, SkyDensity(samplesOf(black)), 64, 1), dvec3(0.0));
}

// --- the unnormalised pair ---------------------------------------------------------------------------------

const dvec3 mean(0.7, 0.5, 0.6);
const glm::dmat3 gradient(dvec3(0.1, -0.2, 0.15), dvec3(0.3, 0.25, 0.1), dvec3(-0.2, 0.05, 0.1));
dvec3 linear(const dvec3& w) {
    return mean + gradient * w;
}

TEST(LinearSky, IsFoundAgain) {
    const LinearSky found = LinearSky::of(sampleSky(linear));
    EXPECT_LE(glm::distance(found.mean, mean), 1e-8);
    for (int i = 0; i < 3; ++i) EXPECT_LE(glm::distance(found.gradient[i], gradient[i]), 1e-8);
}

// In the corner of two planes (or beside any wall, or in any gully): the sky is seen from p1 to p2 across.
TEST(LinearSky, ThePairIsExactInAnyGully) {
    const LinearSky sky{mean, gradient};
    for (const auto& [p1, p2] : {std::pair(0.5 * pi, pi), {0.0, pi}, {0.3, 1.1}, {1.2, 2.9}}) {
        const double A = 0.5 * (std::cos(p1) - std::cos(p2));
        const auto primitive = [](double p) { return p - std::sin(p) * std::cos(p); };
        const dvec3 Bc =
            2.0 / (3.0 * pi) *
            dvec3(std::pow(std::sin(p2), 2) - std::pow(std::sin(p1), 2), primitive(p2) - primitive(p1), 0.0);
        // Across: n = y. Cosine powers up to 4 along the gully and across: sixteen intervals are plenty.
        dvec3 exact(0.0);
        for (int i = 0; i < 16; ++i) {
            const double a = p1 + (p2 - p1) * i / 16.0, b = p1 + (p2 - p1) * (i + 1) / 16.0;
            exact += gauss(a, b, [](double p) {
                dvec3 sum(0.0);
                for (int k = -8; k < 8; ++k)
                    sum += gauss(k * pi / 16.0, (k + 1) * pi / 16.0, [p](double e) {
                        const dvec3 w(std::cos(p) * std::cos(e), std::sin(p) * std::cos(e), std::sin(e));
                        return linear(w) * w.y * std::cos(e);
                    });
                return sum;
            });
        }
        EXPECT_LE(relativeDistance(sky.irradiance(A, Bc), exact), 1e-9);
        // What normalising would do: the length of Bc is at most 2/3.
        EXPECT_GT(relativeDistance(sky.irradiance(A, glm::normalize(Bc)), exact), 0.05);
    }
}

TEST(LinearSky, ThePairIsExactUnderASphere) {
    const LinearSky sky{mean, gradient};
    const double H = 1.6, b = 0.5;  // distance in radii; angle to the normal
    const dvec3 n(0, 1, 0), c(std::sin(b), std::cos(b), 0.0);
    const double mu = std::sqrt(1.0 - 1.0 / (H * H));
    const double A = 1.0 - std::cos(b) / (H * H);
    const double alpha = 2.0 * pi * (1.0 - mu * mu * mu) / 3.0, beta = pi * (1.0 - mu) - 0.5 * alpha;
    const dvec3 Bc = (2.0 * pi / 3.0 * n - beta * n - (alpha - beta) * std::cos(b) * c) / pi;
    // The cap is all above the horizon: what it hides is a polynomial in its own frame.
    const glm::dmat3 frame = frameAround(c);
    const dvec3 hidden = gauss(mu, 1.0, [&](double z) {
        dvec3 ring(0.0);
        for (int i = 0; i < 8; ++i) {
            const double phi = 2.0 * pi * i / 8.0, r = std::sqrt(1.0 - z * z);
            const dvec3 w = frame * dvec3(r * std::cos(phi), r * std::sin(phi), z);
            ring += 2.0 * pi / 8.0 * glm::dot(n, w) * linear(w);
        }
        return ring;
    });
    EXPECT_LE(relativeDistance(sky.irradiance(A, Bc), hemisphereIntegral(linear, n) - hidden), 1e-9);
}

TEST(LinearSky, WhatSeesNothingGetsNothing) {
    EXPECT_EQ((LinearSky{mean, gradient}.irradiance(0.0, dvec3(0.0))), dvec3(0.0));
}

}  // namespace
}  // namespace penumbra
