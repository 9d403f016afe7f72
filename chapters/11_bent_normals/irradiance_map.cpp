#include "chapters/11_bent_normals/irradiance_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/math/hemisphere.h"
#include "common/truth/parallel.h"

namespace penumbra {

namespace {

using std::numbers::pi;

constexpr int groupSide = 8;  ///< samples; of 4 to 32 the quickest
constexpr int smallestLevel = 2, largestLevel = 6;
constexpr int checkedDirections = 384;

double largest(const glm::dvec3& v) {
    return std::max(v.r, std::max(v.g, v.b));
}

/// The sum itself in directions that have nothing to do with rows and columns.
struct Checks {
    std::vector<glm::dvec3> normals, exact;
    double peak = 0.0;  ///< largest value of a channel

    explicit Checks(const CosineConvolution& sky) : normals(checkedDirections), exact(checkedDirections) {
        parallelRows(checkedDirections, [&](int i) {
            normals[std::size_t(i)] = fibonacciSphere(i, checkedDirections);
            exact[std::size_t(i)] = sky.irradiance(normals[std::size_t(i)]);
        });
        for (const glm::dvec3& E : exact) peak = std::max(peak, largest(E));
    }
};

void measure(IrradianceMap& map, const Checks& checks) {
    if (checks.peak == 0.0) return;  // a black sky
    double squares = 0.0;
    for (std::size_t i = 0; i < checks.normals.size(); ++i) {
        const double error = largest(glm::abs(map.at(checks.normals[i]) - checks.exact[i])) / checks.peak;
        squares += error * error;
        map.worst = std::max(map.worst, error);
    }
    map.rmse = std::sqrt(squares / checkedDirections);
}

IrradianceMap convolved(const CosineConvolution& sky, int level, const Checks& checks) {
    const glm::ivec2 size(2 << level, (1 << level) + 1);
    IrradianceMap map{FloatImage(size.x, size.y, 3)};
    parallelRows(size.y, [&](int row) {
        const bool pole = row == 0 || row == size.y - 1;  // one direction, in every column
        const double y = std::cos(pi * row / (size.y - 1));
        glm::dvec3 E(0.0);
        for (int column = 0; column < size.x; ++column) {
            if (!pole || column == 0) E = sky.irradiance(skyDirection(y, 2.0 * pi * column / size.x));
            for (int c = 0; c < 3; ++c) map.texels.at(column, row, c) = float(E[c]);
        }
    });
    measure(map, checks);
    return map;
}

}  // namespace

CosineConvolution::CosineConvolution(SkySamples sky) : sky_(std::move(sky)) {
    for (int row = 0; row < sky_.rows; row += groupSide) {
        for (int column = 0; column < sky_.columns; column += groupSide) {
            Group group{row, column, glm::dvec3(0.0), 0.0};
            const int lastRow = std::min(row + groupSide, sky_.rows);
            const int lastColumn = std::min(column + groupSide, sky_.columns);
            for (int i = row; i < lastRow; ++i)
                for (int j = column; j < lastColumn; ++j) group.axis += sky_.at(i, j).direction;
            group.axis = glm::normalize(group.axis);
            for (int i = row; i < lastRow; ++i) {
                for (int j = column; j < lastColumn; ++j) {
                    const SkySample& sample = sky_.at(i, j);
                    group.power += glm::outerProduct(sample.power, sample.direction);
                    group.sine = std::max(group.sine, glm::length(glm::cross(group.axis, sample.direction)));
                }
            }
            groups_.push_back(group);
        }
    }
}

// [begin:convolve]
glm::dvec3 CosineConvolution::irradiance(const glm::dvec3& n) const {
    glm::dvec3 sum(0.0);
    for (const Group& group : groups_) {
        const double above = glm::dot(n, group.axis);
        if (above <= -group.sine) continue;
        sum += above >= group.sine ? group.power * n : sumOf(group, n);
    }
    return sum;
}
// [end:convolve]

glm::dvec3 CosineConvolution::sumOf(const Group& group, const glm::dvec3& n) const {
    glm::dvec3 sum(0.0);
    for (int i = group.row; i < std::min(group.row + groupSide, sky_.rows); ++i)
        for (int j = group.column; j < std::min(group.column + groupSide, sky_.columns); ++j)
            sum += sky_.at(i, j).power * std::max(0.0, glm::dot(n, sky_.at(i, j).direction));
    return sum;
}

glm::dvec3 CosineConvolution::irradianceOneByOne(const glm::dvec3& n) const {
    glm::dvec3 sum(0.0);
    for (const Group& group : groups_) sum += sumOf(group, n);
    return sum;
}

glm::dvec3 IrradianceMap::at(const glm::dvec3& n) const {
    const double turn = std::atan2(n.x, -n.z) / (2.0 * pi);
    const double x = (turn - std::floor(turn)) * texels.width;
    const double y = std::atan2(std::hypot(n.x, n.z), n.y) / pi * (texels.height - 1);
    const int column = int(x), row = std::min(int(y), texels.height - 2);
    const auto texel = [&](int i, int j) {
        i %= texels.width;
        return glm::dvec3(texels.at(i, j, 0), texels.at(i, j, 1), texels.at(i, j, 2));
    };
    const auto along = [&](int j) { return glm::mix(texel(column, j), texel(column + 1, j), x - column); };
    return glm::mix(along(row), along(row + 1), y - row);
}

IrradianceMap convolveSky(const CosineConvolution& sky, int level) {
    return convolved(sky, level, Checks(sky));
}

// [begin:size]
IrradianceMap smallestIrradianceMap(const CosineConvolution& sky, double tolerance) {
    const Checks checks(sky);
    IrradianceMap map = convolved(sky, smallestLevel, checks);
    for (int level = smallestLevel + 1; level <= largestLevel && map.rmse > tolerance; ++level)
        map = convolved(sky, level, checks);
    return map;
}
// [end:size]

}  // namespace penumbra
