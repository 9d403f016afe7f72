#include "chapters/08_accumulation/light_points.h"

#include <fmt/format.h>

#include <cmath>

#include "chapters/00_ray_traced_truth/light_samples.h"
#include "common/error.h"
#include "common/math/sampling.h"
#include "common/scene/light.h"

namespace penumbra {

namespace {

constexpr int most = 4096;

/// Where in its cell of a grid of `count` cells of equal area point `index` lies: `inCell` in [0,1]^2. The
/// rows divide the points as evenly as whole numbers can, and each is as high as it has points.
glm::dvec2 inGrid(int index, int count, const glm::dvec2& inCell) {
    const int rows = std::max(1, int(std::lround(std::sqrt(double(count)))));
    const auto firstOf = [&](int row) { return int(std::int64_t(row) * count / rows); };
    int row = std::min(rows - 1, int(std::int64_t(index) * rows / count));
    while (firstOf(row + 1) <= index) ++row;
    while (firstOf(row) > index) --row;
    const int first = firstOf(row), columns = firstOf(row + 1) - first;
    return {(index - first + inCell.x) / columns, (first + inCell.y * columns) / count};
}

glm::dvec2 fibonacci(int index, int count, std::uint32_t seed) {
    constexpr double goldenRatio = 0.6180339887498949;
    const glm::dvec2 shift(hashUnit(0, seed, 0), hashUnit(0, seed, 1));
    return glm::fract(glm::dvec2((index + 0.5) / count, index * goldenRatio) + shift);
}

glm::dvec2 inUnitSquare(int index, int count, LightPattern pattern, std::uint32_t seed) {
    const auto i = std::uint32_t(index);
    switch (pattern) {
        case LightPattern::regular:
            return inGrid(index, count, {0.5, 0.5});
        case LightPattern::jittered:
            return inGrid(index, count, {hashUnit(i, seed, 0), hashUnit(i, seed, 1)});
        case LightPattern::fibonacci:
            return fibonacci(index, count, seed);
        case LightPattern::owenSobol:
            return owenSobol(i, seed);
    }
    return {0.5, 0.5};
}

}  // namespace

std::vector<LightPoint> lightPoints(const Light& light, int count, LightPattern pattern, std::uint32_t seed) {
    if (count < 1 || count > most)
        throw Error(fmt::format("{} light points: choose 1 to {}", count, most), exitUsage);
    if (light.type == LightType::directional) return {{-light.direction, 1.0, true}};
    if (light.type != LightType::area) return {{light.position, 1.0}};
    std::vector<LightPoint> points;
    points.reserve(std::size_t(count));
    for (int i = 0; i < count; ++i)
        points.push_back({pointOnLight(light, inUnitSquare(i, count, pattern, seed)), light.area / count});
    return points;
}

}  // namespace penumbra
