#include "common/truth/ambient_forms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/unit/ambient_quadrature.h"

namespace penumbra {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of 93 x 93 nodes for each stretch, rounded in double.
constexpr double quadratureError = 1e-12;

Meridians sphereByMeridians(const glm::dvec3& centre, double radius) {
    const double d = glm::length(centre), sigma = std::asin(radius / d);
    const glm::dvec3 c = centre / d;
    const double sinB = std::hypot(c.x, c.y), phi = std::atan2(c.y, c.x);
    Meridians sky;
    sky.stretch = [c, sigma](double at) {
        const double across = c.x * std::cos(at) + c.y * std::sin(at);
        const double nearest = std::hypot(across, c.z);
        if (nearest <= std::cos(sigma)) return std::pair(0.0, 0.0);
        const double middle = std::atan2(across, c.z),
                     half = std::acos(std::min(1.0, std::cos(sigma) / nearest));
        return std::pair(middle - half, middle + half);
    };
    for (const double sign : {-1.0, 1.0}) {
        if (std::sin(sigma) < sinB) sky.breaks.push_back(phi + sign * std::asin(std::sin(sigma) / sinB));
        if (std::cos(sigma) < sinB) sky.breaks.push_back(phi + sign * std::acos(std::cos(sigma) / sinB));
        sky.breaks.push_back(phi + sign * pi / 2.0);
    }
    return sky;
}

TEST(AmbientForms, SphereByQuadrature) {
    const auto check = [](const glm::dvec3& centre, double radius) {
        EXPECT_LE(
            difference(ambientUnderSphere(centre, radius), quadrature(sphereByMeridians(centre, radius))),
            quadratureError)
            << centre.x << " " << centre.y << " " << centre.z << " radius " << radius;
    };
    check({0, 0, 2}, 1.0);             // overhead
    check({0.3, 0.1, 1.2}, 1.1);       // covers the zenith
    check({1.0, -2.0, 1.5}, 0.7);      // whole
    check({2.0, 1.0, 0.4}, 1.0);       // cut by the horizon
    check({0.6, 0.7, -0.3}, 0.8);      // its centre below the horizon
    check({3.0, 0.0, 0.0}, 1.0);       // half of it
    check({1.0, 0.0, 0.999999}, 1.0);  // nearly tangent to the horizon
    check({1.0, 0.0, 1.000001}, 1.0);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 centre(uniform(random), uniform(random), uniform(random));
        check(centre, glm::length(centre) * (0.05 + 0.45 * (1.0 + uniform(random))));
    }
}

TEST(AmbientForms, SphereByItsClosedForms) {
    const glm::dvec3 centre(1.0, -2.0, 2.5);
    const double d = glm::length(centre), radius = 1.5, sine = radius / d, mu = std::sqrt(1.0 - sine * sine);
    const AmbientForm form = ambientUnderSphere(centre, radius);
    EXPECT_NEAR(form.cosine, 1.0 - sine * sine * centre.z / d, 1e-15);
    EXPECT_NEAR(form.uniform, mu, 1e-15);
    const glm::dvec3 normal(0, 0, 1);
    EXPECT_LE(glm::length(form.uniformBent - 0.5 * (normal - sine * sine * centre / d)), 1e-15);
    const double alpha = 2.0 * pi * (1.0 - mu * mu * mu) / 3.0, beta = pi * (1.0 - mu) - 0.5 * alpha;
    EXPECT_LE(
        glm::length(form.cosineBent -
                    (2.0 / 3.0 * normal - (beta * normal + (alpha - beta) * centre.z / d * centre / d) / pi)),
        1e-15);
    // Resting on the ground: the cap only just touches the horizon.
    for (const double away : {1e-3, 0.5, 1.0, 3.0, 100.0}) {
        const double expected = 1.0 - 1.0 / std::pow(away * away + 1.0, 1.5);
        EXPECT_NEAR(ambientUnderSphere({away, 0, 1}, 1.0).cosine, expected, 1e-14) << away;
    }
    EXPECT_NEAR(ambientUnderSphere({0, 0, 1}, 1.0).cosine, 0.0, 1e-15) << "in contact nothing is seen";
    EXPECT_EQ(difference(ambientUnderSphere({1, 2, -4}, 3.9), AmbientForm()), 0.0) << "below the horizon";
}

Meridians profileByMeridians(double from, double to) {
    Meridians sky;
    sky.breaks = {pi / 2.0, 3.0 * pi / 2.0};
    sky.outside = 0.0;
    sky.within = [](const glm::dvec3&) { return 1.0; };
    sky.stretch = [from, to](double phi) {
        const double side = std::cos(phi);
        const auto reached = [&](double profile) {
            return std::atan2(std::abs(std::cos(profile)), std::sin(profile) * std::abs(side));
        };
        const double near = side > 0.0 ? pi - to : from;  // mirrored, so that this side is pi/2 to pi
        const double far = side > 0.0 ? pi - from : to;
        if (far <= pi / 2.0) return std::pair(0.0, 0.0);
        return std::pair(near > pi / 2.0 ? reached(near) : 0.0, reached(far));
    };
    return sky;
}

TEST(AmbientForms, OfASphereThatTouchesThePointAWedgeIsLeftHoweverThin) {
    for (const double angle : {1e-12, 1e-9, 1e-6, 1e-3, 0.1, 1.0}) {
        const AmbientForm form = ambientUnderSphere({std::sin(angle), 0.0, std::cos(angle)}, 1.0);
        const AmbientForm wedge = ambientInProfile(std::numbers::pi - angle, std::numbers::pi);
        EXPECT_LE(difference(form, wedge), 1e-15) << angle;
    }
}

TEST(AmbientForms, ProfilesByQuadrature) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> angle(0.0, pi);
    for (int i = 0; i < 20; ++i) {
        const double a = angle(random), b = angle(random), from = std::min(a, b), to = std::max(a, b);
        EXPECT_LE(difference(ambientInProfile(from, to), quadrature(profileByMeridians(from, to))),
                  quadratureError)
            << from << " to " << to;
    }
    EXPECT_LE(difference(ambientInProfile(0.0, pi), AmbientForm()), 1e-15);
    EXPECT_LE(difference(ambientInProfile(1.0, 1.0), zeroForm()), 1e-15);
}

TEST(AmbientForms, PerpendicularPlanesTellTheWeightingsApart) {
    const AmbientForm corner = ambientBesideWall(0.7, infinity);
    EXPECT_NEAR(corner.cosine, 0.5, 1e-15);
    EXPECT_NEAR(corner.uniform, 0.5, 1e-15);
    EXPECT_NEAR(lean(corner.cosineBent), std::atan(2.0 / pi) * 180.0 / pi, 1e-12);
    EXPECT_NEAR(lean(corner.cosineBent), 32.48, 0.005);
    EXPECT_NEAR(lean(corner.uniformBent), 45.0, 1e-12);
    EXPECT_LT(corner.cosineBent.x, 0.0) << "away from the wall";
}

TEST(AmbientForms, WallsAndGullies) {
    for (const double x : {0.01, 0.5, 3.0}) {
        for (const double h : {0.1, 1.0, 20.0}) {
            const auto open = [h](double away) { return away / std::hypot(away, h); };
            EXPECT_NEAR(ambientBesideWall(x, h).cosine, 0.5 * (1.0 + open(x)), 1e-15);
            EXPECT_NEAR(ambientOnGullyFloor(x, 4.0, h).cosine, 0.5 * (open(x) + open(4.0 - x)), 1e-15);
            EXPECT_NEAR(ambientOnGullyWall(h, x).cosine, 0.5 * (1.0 - h / std::hypot(h, x)), 1e-15);
            // The same wall, looked at from the floor beside it and as a gully of infinite width.
            const AmbientForm wide = ambientOnGullyFloor(x, infinity, h), wall = ambientBesideWall(x, h);
            EXPECT_NEAR(wide.cosine, wall.cosine, 1e-15);
            EXPECT_NEAR(wide.cosineBent.x, -wall.cosineBent.x, 1e-15) << "the wall is at -x";
        }
    }
    for (const double g : {0.01, 0.5, pi / 4.0, 1.5}) {
        EXPECT_NEAR(ambientInVGully(g).cosine, std::sin(g) * std::sin(g), 1e-15);
        EXPECT_NEAR(ambientInVGully(g).uniform, 2.0 * g / pi, 1e-15);
        EXPECT_GT(ambientInVGully(g).cosineBent.x, 0.0) << "leans out of the gully";
    }
    EXPECT_LE(difference(ambientBesideWall(1.0, 0.0), AmbientForm()), 1e-15) << "no wall";
    EXPECT_NEAR(ambientOnGullyWall(0.0, 1.0).cosine, 0.5, 1e-15) << "at the rim";
}

TEST(AmbientForms, SlopesAreTheHemisphereTerm) {
    for (const double tilt : {0.0, 0.3, pi / 2.0, 3.0, pi}) {
        EXPECT_NEAR(ambientOnSlope(tilt).cosine, 0.5 * (1.0 + std::cos(tilt)), 1e-15);
        EXPECT_NEAR(ambientOnSlope(tilt).uniform, 1.0 - tilt / pi, 1e-15);
    }
    EXPECT_LT(ambientOnSlope(0.5).cosineBent.x, 0.0) << "uphill, towards the zenith";
}

TEST(AmbientForms, TrenchIsBrightestAtTheBottomAlthoughItsApertureIsConstant) {
    for (const double rim : {0.4, pi / 2.0, 2.5}) {
        double before = 2.0;
        for (double angle = 0.0; angle <= rim; angle += rim / 8.0) {
            const AmbientForm form = ambientInTrench(rim, angle);
            EXPECT_NEAR(form.cosine, std::cos(0.5 * rim) * std::cos(0.5 * angle), 1e-15);
            EXPECT_NEAR(form.uniform, 1.0 - rim / pi, 1e-15);
            EXPECT_LT(form.cosine, before);
            before = form.cosine;
            // The uniform bent normal points at the top of the circle, which is half as far from the normal.
            EXPECT_NEAR(lean(form.uniformBent), 0.5 * angle * 180.0 / pi, 1e-12);
            EXPECT_GE(form.uniformBent.x * 1e15, angle > 0.0 ? 1.0 : -1.0) << "+x leads up to the near rim";
        }
    }
    EXPECT_NEAR(ambientInTrench(pi / 2.0, 0.0).cosine, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(ambientInTrench(pi / 2.0, pi / 2.0).cosine, 0.5, 1e-15);
}

/// The pit's opening as a cap of the sphere, gone over by its own latitude and longitude: dw = dA / (4 cos b)
/// for a unit sphere, b being the angle of the chord with the normals at both of its ends.
AmbientForm pitByItsOpening(double rim, double angle) {
    const glm::dvec3 point(std::sin(angle), 0.0, -std::cos(angle));
    const glm::dvec3 normal = -point, tangent(std::cos(angle), 0.0, std::sin(angle));
    AmbientForm form = zeroForm();
    integrate(rim, pi, [&](double polar, double height) {
        for (const double half : {0.0, pi})
            integrate(half, half + pi, [&](double turn, double width) {
                const double s = std::sin(polar);
                const glm::dvec3 q(s * std::cos(turn), s * std::sin(turn), -std::cos(polar));
                const glm::dvec3 chord = q - point, w = glm::normalize(chord);
                addDirection(form, {glm::dot(w, tangent), w.y, glm::dot(w, normal)},
                             height * width * s / (2.0 * glm::length(chord)));
            });
    });
    return form;
}

TEST(AmbientForms, PitIsTheSameEverywhere) {
    for (const double rim : {0.3, pi / 2.0, 2.0, 3.0}) {
        for (const double part : {0.0, 0.3, 0.9, 0.999}) {
            const AmbientForm form = ambientInPit(rim, part * rim);
            EXPECT_NEAR(form.cosine, 0.5 * (1.0 + std::cos(rim)), 1e-13) << rim << " " << part;
            if (part > 0.99) continue;  // where the plain quadrature would need more points
            EXPECT_LE(difference(form, pitByItsOpening(rim, part * rim)), quadratureError)
                << rim << " " << part;
        }
    }
    EXPECT_NEAR(ambientInPit(pi / 2.0, 1.0).cosine, 0.5, 1e-14);
    // From the bottom the rim is a circle about the normal, half as far from it as from the centre.
    EXPECT_NEAR(ambientInPit(1.0, 0.0).uniform, 1.0 - std::cos(0.5 * (pi - 1.0)), 1e-14);
}

TEST(AmbientForms, DisksByQuadratureAndByHamiltonAndMorgan) {
    const auto check = [](double r, double h, double a) {
        const AmbientForm form = ambientUnderDisk(r, h, a);
        const double sum = h * h + a * a + r * r;
        const double lost = 0.5 * (1.0 - (sum - 2.0 * r * r) / std::sqrt(sum * sum - 4.0 * a * a * r * r));
        EXPECT_NEAR(form.cosine, 1.0 - lost, 1e-13) << r << " " << h << " " << a;
        Meridians sky;
        sky.stretch = [=](double phi) {
            const double s = a * std::sin(phi), root = r * r - s * s;
            if (root <= 0.0) return std::pair(0.0, 0.0);
            const double near = a * std::cos(phi) - std::sqrt(root),
                         far = a * std::cos(phi) + std::sqrt(root);
            return std::pair(std::atan2(std::max(0.0, near), h), std::atan2(std::max(0.0, far), h));
        };
        if (a > r) sky.breaks = {std::asin(r / a), -std::asin(r / a)};
        EXPECT_LE(difference(form, quadrature(sky)), quadratureError) << r << " " << h << " " << a;
    };
    check(1.0, 0.5, 0.0);
    check(1.0, 1.0, 0.5);
    check(1.0, 0.2, 3.0);
    check(0.3, 5.0, 2.0);
    EXPECT_NEAR(ambientUnderDisk(2.0, 1.5, 0.0).uniform, 1.5 / std::hypot(2.0, 1.5), 1e-15);
    // A disk far below its rim's blur is still right: the sum takes more points.
    EXPECT_NEAR(ambientUnderDisk(1.0, 1e-3, 1.0).cosine, 1.0 - 0.5 * (1.0 - 1e-3 / std::sqrt(4.0 + 1e-6)),
                1e-12);
}

/// int int X.. of a rectangle with one corner over the point, as heat transfer handbooks have it.
double cornerFormFactor(double x, double y, double h) {
    const double a = x / std::hypot(x, h), b = y / std::hypot(x, h), c = y / std::hypot(y, h),
                 d = x / std::hypot(y, h);
    return (a * std::atan(b) + c * std::atan(d)) / (2.0 * pi);
}

double cornerSolidAngle(double x, double y, double h) {
    return std::atan2(x * y, h * std::sqrt(x * x + y * y + h * h));
}

TEST(AmbientForms, RectanglesByQuadratureAndByTheirCorners) {
    const auto check = [](const glm::dvec2& lower, const glm::dvec2& upper, double h) {
        const AmbientForm form = ambientUnderRectangle(lower, upper, h);
        double factor = 0.0, angle = 0.0;
        Meridians sky;
        for (const double sx : {-1.0, 1.0})
            for (const double sy : {-1.0, 1.0}) {
                const double x = sx < 0.0 ? lower.x : upper.x, y = sy < 0.0 ? lower.y : upper.y;
                factor += sx * sy * cornerFormFactor(x, y, h);
                angle += sx * sy * cornerSolidAngle(x, y, h);
                sky.breaks.push_back(std::atan2(y, x));
            }
        EXPECT_NEAR(form.cosine, 1.0 - factor, 1e-14);
        EXPECT_NEAR(form.uniform, 1.0 - angle / (2.0 * pi), 1e-14);
        sky.breaks.insert(sky.breaks.end(), {pi / 2.0, pi, 3.0 * pi / 2.0});
        sky.stretch = [=](double phi) {
            double from = 0.0, to = 1e30;
            const glm::dvec2 along(std::cos(phi), std::sin(phi));
            for (int axis = 0; axis < 2; ++axis) {
                const double first = lower[axis] / along[axis], second = upper[axis] / along[axis];
                from = std::max(from, std::min(first, second));
                to = std::min(to, std::max(first, second));
            }
            return from < to ? std::pair(std::atan2(from, h), std::atan2(to, h)) : std::pair(0.0, 0.0);
        };
        EXPECT_LE(difference(form, quadrature(sky)), quadratureError);
    };
    check({-1.0, -2.0}, {0.5, 1.0}, 0.7);  // overhead
    check({1.0, -1.0}, {2.0, 3.0}, 1.0);
    check({2.0, 1.0}, {3.0, 1.5}, 0.3);
}

TEST(AmbientForms, WallsWithinARangeByQuadrature) {
    for (const double k : {0.05, 0.3, 0.8, 0.99}) {
        const double range = 2.5, t = std::acos(k);
        Meridians sky;
        sky.breaks = {t, -t};
        sky.stretch = [k](double phi) {
            return std::cos(phi) > k ? std::pair(std::asin(k / std::cos(phi)), pi / 2.0)
                                     : std::pair(0.0, 0.0);
        };
        const AmbientForm hard = ambientBesideWallWithin(k * range, range);
        EXPECT_LE(difference(hard, quadrature(sky)), quadratureError) << k;
        EXPECT_NEAR(hard.cosine, 1.0 - (t - std::sin(t) * k) / pi, 1e-15);
        EXPECT_NEAR(hard.uniform, 0.5 * (1.0 + k), 1e-15);
        sky.within = [k](const glm::dvec3& w) {
            const double nearness = std::max(0.0, 1.0 - k / w.x);
            return 1.0 - nearness * nearness;
        };
        const AmbientForm fading = ambientBesideFadingWall(k * range, range);
        EXPECT_LE(difference(fading, quadrature(sky)), quadratureError) << k;
        EXPECT_GT(fading.cosine, hard.cosine);
    }
    EXPECT_EQ(difference(ambientBesideWallWithin(2.0, 2.0), AmbientForm()), 0.0);
    EXPECT_EQ(difference(ambientBesideFadingWall(3.0, 2.0), AmbientForm()), 0.0);
    EXPECT_LE(difference(ambientBesideWallWithin(1e-9, 1.0), ambientBesideWall(1.0, infinity)), 1e-8)
        << "a long range is no range";
}

TEST(AmbientForms, OvercastSky) {
    EXPECT_NEAR(overcastIrradiance(AmbientForm(), {0, 0, 1}), 7.0 * pi / 9.0, 1e-15);
    for (const double tilt : {0.2, 1.0, 2.5}) {
        const glm::dvec3 up(-std::sin(tilt), 0.0, std::cos(tilt));
        Meridians sky = profileByMeridians(tilt, pi);
        sky.radiance = [up](const glm::dvec3& w) { return (1.0 + 2.0 * glm::dot(up, w)) / 3.0; };
        EXPECT_NEAR(overcastIrradiance(ambientOnSlope(tilt), up), pi * quadrature(sky).cosine,
                    quadratureError);
    }
}

/// V in [0,1], so no bent vector is longer than an open sky makes it, and both visibilities are in [0,1].
void expectSane(const AmbientForm& form) {
    const double rounding = 1e-12;
    EXPECT_TRUE(form.cosine >= -rounding && form.cosine <= 1.0 + rounding) << form.cosine;
    EXPECT_TRUE(form.uniform >= -rounding && form.uniform <= 1.0 + rounding) << form.uniform;
    // Sum of directions, none longer than 1: and false for NaN.
    EXPECT_TRUE(glm::length(form.cosineBent) <= form.cosine + rounding) << form.cosineBent.x;
    EXPECT_TRUE(glm::length(form.uniformBent) <= form.uniform + rounding) << form.uniformBent.x;
}

TEST(AmbientForms, NeverNan) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    // Half of all numbers are 0, 1 or a hair beside it.
    const auto number = [&] {
        constexpr double special[] = {0.0, 1e-300, 1e-16, 1e-8, 0.5, 1.0 - 1e-16, 1.0};
        return uniform(random) < 0.5 ? special[random() % 7] : uniform(random);
    };
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 c(2.0 * number() - 1.0, 2.0 * number() - 1.0, 2.0 * number() - 1.0);
        if (glm::length(c) > 0.0)
            expectSane(ambientUnderSphere(c, glm::length(c) * std::max(1e-9, number())));
        const double a = pi * number(), b = pi * number(), x = 1e-12 + number(), y = 1e-12 + number();
        expectSane(ambientInProfile(std::min(a, b), std::max(a, b)));
        expectSane(ambientBesideWall(x, number()));
        expectSane(ambientOnGullyFloor(x, x + y, number()));
        expectSane(ambientOnGullyWall(number(), y));
        expectSane(ambientInTrench(a, a * number()));
        expectSane(ambientBesideWallWithin(x, y));
        expectSane(ambientBesideFadingWall(x, y));
        expectSane(ambientUnderRectangle({c.x, c.y}, {c.x + x, c.y + y}, 1e-6 + number()));
    }
    for (int i = 0; i < 300; ++i) {
        const double rim = 1e-3 + 3.0 * number();
        expectSane(ambientInPit(rim, 0.999 * rim * number()));
        expectSane(ambientUnderDisk(1e-6 + number(), 1e-3 + number(), 2.0 * number()));
    }
}

}  // namespace
}  // namespace penumbra
