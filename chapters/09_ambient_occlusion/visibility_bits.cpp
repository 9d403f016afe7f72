#include "chapters/09_ambient_occlusion/visibility_bits.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "common/math/hemisphere.h"
#include "common/math/wide.h"
#include "common/truth/parallel.h"

namespace penumbra {

namespace {

constexpr std::size_t byteBits = 8;
constexpr int pointsAtOnce = 1024;

/// Eight numbers side by side: one instruction or a few, whatever the processor has.
using Eight [[gnu::vector_size(32)]] = float;

/// For each byte what its bits multiply by: a table look-up instead of eight shifts and comparisons.
std::array<Eight, 256> factorTable() {
    std::array<Eight, 256> table{};
    for (std::size_t byte = 0; byte < 256; ++byte)
        for (std::size_t bit = 0; bit < byteBits; ++bit) table[byte][bit] = float(byte >> bit & 1u);
    return table;
}

/// Eight directions and what comes from them.
struct EightLights {
    Eight x{}, y{}, z{};
    Eight red{}, green{}, blue{};
};

std::vector<EightLights> sideBySide(std::span<const glm::vec3> directions,
                                    std::span<const glm::vec3> radiance) {
    std::vector<EightLights> lights((directions.size() + byteBits - 1) / byteBits);
    const float solidAngle = 4.0f * std::numbers::pi_v<float> / float(directions.size());
    for (std::size_t l = 0; l < directions.size(); ++l) {
        EightLights& eight = lights[l / byteBits];
        const std::size_t k = l % byteBits;
        eight.x[k] = directions[l].x, eight.y[k] = directions[l].y, eight.z[k] = directions[l].z;
        eight.red[k] = radiance[l].x * solidAngle, eight.green[k] = radiance[l].y * solidAngle;
        eight.blue[k] = radiance[l].z * solidAngle;
    }
    return lights;
}

// [begin:relight]
/// The irradiance of one point. `words`: its bits; `factors`: of factorTable.
PENUMBRA_WIDE glm::vec3 irradiance(const std::uint64_t* words, const glm::vec3& normal,
                                   std::span<const EightLights> lights, const Eight* factors) {
    Eight red{}, green{}, blue{};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::uint64_t byte = words[i / byteBits] >> (byteBits * (i % byteBits)) & 0xff;
        if (byte == 0) continue;
        const EightLights& light = lights[i];
        const Eight cosine = normal.x * light.x + normal.y * light.y + normal.z * light.z;
        const Eight seen = (cosine > 0.0f ? cosine : Eight{}) * factors[byte];
        red += seen * light.red;
        green += seen * light.green;
        blue += seen * light.blue;
    }
    glm::vec3 sum(0.0f);
    for (std::size_t k = 0; k < byteBits; ++k) sum += glm::vec3(red[k], green[k], blue[k]);
    return sum;
}
// [end:relight]

}  // namespace

VisibilityBits VisibilityBits::allBlocked(std::vector<glm::vec3> directions, std::size_t points) {
    VisibilityBits bits;
    bits.directions = std::move(directions);
    bits.points = points;
    bits.words.assign(points * bits.wordsPerPoint(), 0);
    return bits;
}

std::vector<glm::vec3> skyDirections(int count) {
    std::vector<glm::vec3> directions;
    for (int i = 0; i < count; ++i) directions.emplace_back(fibonacciSphere(i, count));
    return directions;
}

std::vector<glm::vec3> skyRadiance(const Sky& sky, std::span<const glm::vec3> directions) {
    std::vector<glm::vec3> radiance;
    for (const glm::vec3& direction : directions) radiance.emplace_back(sky.radiance(glm::dvec3(direction)));
    return radiance;
}

void addSun(std::span<const glm::vec3> directions, const glm::dvec3& toSun, const glm::dvec3& sun,
            std::span<glm::vec3> radiance) {
    const auto nearer = [&](const glm::vec3& a, const glm::vec3& b) {
        return glm::dot(glm::dvec3(a), toSun) < glm::dot(glm::dvec3(b), toSun);
    };
    const auto nearest = std::max_element(directions.begin(), directions.end(), nearer);
    const double solidAngle = 4.0 * std::numbers::pi / double(directions.size());
    radiance[std::size_t(nearest - directions.begin())] += glm::vec3(sun / solidAngle);
}

std::vector<glm::vec3> relight(const VisibilityBits& bits, std::span<const glm::vec3> normals,
                               std::span<const glm::vec3> radiance) {
    const std::vector<EightLights> lights = sideBySide(bits.directions, radiance);
    static const std::array<Eight, 256> factors = factorTable();
    std::vector<glm::vec3> result(bits.points);
    const int points = int(bits.points);
    parallelRows((points + pointsAtOnce - 1) / pointsAtOnce, [&](int row) {
        for (int i = row * pointsAtOnce; i < std::min(points, (row + 1) * pointsAtOnce); ++i) {
            const auto point = std::size_t(i);
            result[point] =
                irradiance(&bits.words[point * bits.wordsPerPoint()], normals[point], lights, factors.data());
        }
    });
    return result;
}

AmbientValue ambientFromBits(const VisibilityBits& bits, std::size_t point, const glm::dvec3& normal,
                             Weighting weighting) {
    AmbientValue value{0.0, glm::dvec3(0.0)};
    for (std::size_t l = 0; l < bits.directions.size(); ++l) {
        if (!bits.open(point, l)) continue;
        const glm::dvec3 direction(bits.directions[l]);
        const double cosine = glm::dot(normal, direction);
        if (cosine <= 0.0) continue;
        const double weight = weighting == Weighting::cosine ? 2.0 * cosine : 1.0;
        value.visibility += weight;
        value.bent += weight * direction;
    }
    // The density of directions on the hemisphere is count / 2.
    const double scale = 2.0 / double(bits.directions.size());
    return {scale * value.visibility, scale * value.bent};
}

}  // namespace penumbra
