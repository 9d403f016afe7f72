#include "common/truth/ambient_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr double pi = std::numbers::pi;

/// An integral times (1 - k / cos)^2, from what it is alone, divided by the cosine, and by its square.
double fading(double ones, double overCosine, double overCosine2, double k) {
    return ones - 2.0 * k * overCosine + k * k * overCosine2;
}

}  // namespace

AmbientForm ambientThrough(const DirectionMoments& region) {
    return {region.first.z / pi, region.solidAngle / (2.0 * pi), region.second / pi,
            region.first / (2.0 * pi)};
}

AmbientForm ambientBesides(const DirectionMoments& blocked) {
    AmbientForm form;
    const AmbientForm lost = ambientThrough(blocked);
    form.cosine -= lost.cosine;
    form.uniform -= lost.uniform;
    form.cosineBent -= lost.cosineBent;
    form.uniformBent -= lost.uniformBent;
    return form;
}

AmbientForm ambientUnderSphere(const glm::dvec3& centre, double radius) {
    const double d = glm::length(centre);
    const double cosine = std::sqrt(std::max(0.0, (d - radius) * (d + radius))) / d;
    return ambientBesides(capMoments(centre / d, std::min(1.0, radius / d), cosine));
}

AmbientForm ambientInProfile(double from, double to) {
    return ambientThrough(wedgeMoments(from, to));
}

AmbientForm ambientBesideWall(double distance, double height) {
    return ambientInProfile(std::atan2(height, distance), pi);
}

AmbientForm ambientOnSlope(double tilt) {
    return ambientInProfile(tilt, pi);
}

AmbientForm ambientInVGully(double halfOpening) {
    return ambientInProfile(0.0, 2.0 * halfOpening);
}

AmbientForm ambientOnGullyFloor(double x, double width, double depth) {
    return ambientInProfile(std::atan2(depth, width - x), pi - std::atan2(depth, x));
}

AmbientForm ambientOnGullyWall(double below, double width) {
    return ambientInProfile(0.0, std::atan2(width, below));
}

AmbientForm ambientInTrench(double rim, double angle) {
    // A chord makes half its arc with the tangent.
    return ambientInProfile(0.5 * (rim - angle), pi - 0.5 * (rim + angle));
}

AmbientForm ambientInPit(double rim, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dvec3 outwards(c, 0.0, -s), up(s, 0.0, c);  // of the pit, in the frame of the point
    const double radius = std::sin(rim);
    // cos(angle) - cos(rim), of close angles too
    const double height = 2.0 * std::sin(0.5 * (rim + angle)) * std::sin(0.5 * (rim - angle));
    return ambientThrough(diskMoments(height * up - s * outwards, radius * outwards, {0.0, radius, 0.0}));
}

AmbientForm ambientUnderDisk(double radius, double height, double offset) {
    return ambientBesides(diskMoments({offset, 0.0, height}, {radius, 0.0, 0.0}, {0.0, radius, 0.0}));
}

AmbientForm ambientUnderRectangle(const glm::dvec2& lower, const glm::dvec2& upper, double height) {
    const std::array<glm::dvec3, 4> corners = {glm::dvec3(lower.x, lower.y, height),
                                               {lower.x, upper.y, height},
                                               {upper.x, upper.y, height},
                                               {upper.x, lower.y, height}};
    return ambientBesides(polygonMoments(corners));
}

AmbientForm ambientBesideWallWithin(double distance, double range) {
    // The wall is `range` away along a cone about its normal: half a cap is blocked.
    const double k = distance / range;
    if (k >= 1.0) return {};
    return ambientBesides(capMoments({1.0, 0.0, 0.0}, std::sqrt((1.0 - k) * (1.0 + k)), k));
}

// Directions go by their angle a from the wall's normal x and by their turn about it, from 0 to pi. The turn
// is integrated away: w.z has the mean 2/pi sin a, its square sin^2 a / 2. What is left is integrals over a
// from 0 to t.
AmbientForm ambientBesideFadingWall(double distance, double range) {
    const double k = distance / range;
    if (k >= 1.0) return {};
    const double s = std::sqrt((1.0 - k) * (1.0 + k)), t = std::atan2(s, k);
    const double sinCubed = (1.0 - k) * (1.0 - k) * (2.0 + k) / 3.0;
    const double logCosine = std::log(k), secant = std::asinh(s / k);  // of 1 / cos
    DirectionMoments m;
    m.solidAngle = pi * fading(1.0 - k, -logCosine, 1.0 / k - 1.0, k);
    m.first.x = pi * fading(0.5 * s * s, 1.0 - k, -logCosine, k);
    m.first.z = 2.0 * fading(0.5 * (t - s * k), secant - s, s / k - t, k);
    m.second.x = 2.0 * fading(s * s * s / 3.0, 0.5 * (t - s * k), secant - s, k);
    m.second.z = 0.5 * pi * fading(sinCubed, -logCosine - 0.5 * s * s, (1.0 - k) * (1.0 - k) / k, k);
    return ambientBesides(m);
}

double overcastIrradiance(const AmbientForm& seen, const glm::dvec3& up) {
    return pi / 3.0 * (seen.cosine + 2.0 * glm::dot(up, seen.cosineBent));
}

}  // namespace penumbra
