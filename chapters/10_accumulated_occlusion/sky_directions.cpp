#include "chapters/10_accumulated_occlusion/sky_directions.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "common/error.h"
#include "common/math/hemisphere.h"
#include "common/math/sampling.h"

namespace penumbra {

namespace {

std::vector<glm::dvec3> randomSphere(int count, std::uint32_t seed) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - 2.0 * hashUnit(std::uint32_t(i), seed, 0);
        const double turn = 2.0 * std::numbers::pi * hashUnit(std::uint32_t(i), seed, 1);
        const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
        directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
    }
    return directions;
}

}  // namespace

const std::vector<std::string>& directionPatternNames() {
    static const std::vector<std::string> names{"fibonacci", "owen-sobol", "random"};
    return names;
}

// [begin:directions]
std::vector<glm::dvec3> skyDirections(int count, const std::string& pattern, std::uint32_t seed) {
    std::vector<glm::dvec3> directions;
    if (pattern == "random") directions = randomSphere(count, seed);
    if (pattern == "owen-sobol") directions = owenSobolSphere(count, seed);
    if (pattern == "fibonacci")
        for (int i = 0; i < count; ++i) directions.push_back(fibonacciSphere(i, count));
    if (directions.empty()) throw UsageError("--directions " + pattern + ": no such pattern");
    // The patterns are best along their axis. Most scenes stand on a ground, whose horizon is the longest
    // edge in anybody's sky: the axis points up, and the horizon falls between two rows.
    for (glm::dvec3& l : directions) l = {l.y, l.z, l.x};
    return directions;
}
// [end:directions]

double cellTangent(int count) {
    // The cap's height is 2 / count: spheres are as wide as their enclosing cylinder (Archimedes).
    const double cosine = 1.0 - 2.0 / count;
    constexpr double most = 0.5;
    return cosine > 1.0 / std::sqrt(1.0 + most * most) ? std::sqrt(1.0 - cosine * cosine) / cosine : most;
}

glm::dmat3 skyRotation(std::uint32_t index, std::uint32_t seed) {
    if (index == 0) return glm::dmat3(1.0);
    const double u = hashUnit(index, seed, 2);
    const double a = 2.0 * std::numbers::pi * hashUnit(index, seed, 3);
    const double b = 2.0 * std::numbers::pi * hashUnit(index, seed, 4);
    const double s = std::sqrt(1.0 - u), t = std::sqrt(u);
    return glm::mat3_cast(glm::dquat(t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)));
}

}  // namespace penumbra
