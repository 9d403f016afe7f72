#include "assets/make/environments.h"

#include <algorithm>
#include <cmath>

namespace penumbra::assets {
namespace {

using Vec3 = glm::dvec3;

/// 1 within `cosine` of `axis`, 0 beyond; a texel's breadth of transition.
double disk(const Vec3& w, const Vec3& axis, double cosine) {
    const double softness = 0.15 * (1.0 - cosine);
    return smoothStep(cosine - softness, cosine + softness, glm::dot(w, axis));
}

/// 1 inside a window of the wall at distance 1 along `wall` (horizontal, unit), between the given places.
double window(const Vec3& w, const Vec3& wall, double left, double right, double sill, double top) {
    const double distance = glm::dot(w, wall);
    if (distance <= 0.05) return 0.0;
    const Vec3 sideways(-wall.z, 0.0, wall.x);
    const double x = glm::dot(w, sideways) / distance, y = w.y / distance;
    constexpr double frame = 0.02;
    // The top is an arch over the window's own breadth.
    const double middle = 0.5 * (left + right), half = 0.5 * (right - left);
    const double archX = (x - middle) / half;
    const double roof = top + half * std::sqrt(std::max(0.0, 1.0 - archX * archX));
    return smoothStep(left - frame, left + frame, x) * smoothStep(-right - frame, -right + frame, -x) *
           smoothStep(sill - frame, sill + frame, y) * smoothStep(-roof - frame, -roof + frame, -y);
}

Vec3 clearSky(const Vec3& w) {
    const Vec3 sun = glm::normalize(Vec3(0.55, 0.95, 0.58));
    const Vec3 zenith(0.16, 0.28, 0.55), horizon(0.62, 0.68, 0.72), ground(0.20, 0.17, 0.13);
    const double towardsSun = std::max(0.0, glm::dot(w, sun));
    // Haze is thick along the ground, and bright around the sun.
    const double haze = std::pow(1.0 - std::clamp(w.y, 0.0, 1.0), 3.0);
    const double glow = std::pow(towardsSun, 24.0);
    const Vec3 sky = glm::mix(zenith, horizon, haze) + glow * Vec3(1.0, 0.9, 0.7);
    const Vec3 lit = glm::mix(ground, sky, smoothStep(-0.02, 0.02, w.y));
    return lit + 420.0 * disk(w, sun, std::cos(glm::radians(2.5))) * Vec3(1.0, 0.92, 0.78);
}

Vec3 chapel(const Vec3& w) {
    const Vec3 stone = glm::mix(Vec3(0.10, 0.085, 0.07), Vec3(0.045, 0.042, 0.045), 0.5 + 0.5 * w.y);
    double sky = 0.0;
    for (const double left : {-1.05, -0.2, 0.65}) sky += window(w, {0, 0, -1}, left, left + 0.4, 0.1, 0.75);
    const Vec3 round = glm::normalize(Vec3(1.0, 0.55, 0.0)), lamp = glm::normalize(Vec3(-0.4, 0.7, 0.5));
    return stone + sky * Vec3(6.0, 7.0, 9.0) + disk(w, round, 0.985) * Vec3(22.0, 11.0, 4.0) +
           disk(w, lamp, std::cos(glm::radians(3.0))) * Vec3(60.0, 44.0, 22.0);
}

}  // namespace

Environment makeClearSky() {
    return {256, 128, clearSky};
}

Environment makeChapel() {
    return {256, 128, chapel};
}

}  // namespace penumbra::assets
