#include "chapters/11_bent_normals/sky_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "chapters/09_ambient_occlusion/sky.h"

namespace penumbra {

namespace {

using std::numbers::pi;

constexpr int samplesDown = 2, samplesAcross = 4;  ///< of the quadrature, in a cell

struct Chosen {
    int index;
    double within;  ///< the rest of the random number, in [0,1)
};

/// Where `u` of the way to the end of the running sums `ends` lies.
Chosen choose(std::span<const double> ends, double u) {
    const double wanted = u * ends.back();
    auto index = std::upper_bound(ends.begin(), ends.end(), wanted) - ends.begin();
    index = std::min(index, std::ptrdiff_t(ends.size()) - 1);
    const double before = index == 0 ? 0.0 : ends[std::size_t(index) - 1];
    const double share = ends[std::size_t(index)] - before;
    return {int(index), share > 0.0 ? std::clamp((wanted - before) / share, 0.0, 1.0 - 1e-12) : 0.5};
}

}  // namespace

SkyDensity::SkyDensity(const SkySamples& sky)
    : rows_(sky.rows / samplesDown), columns_(sky.columns / samplesAcross) {
    for (int row = 0; row < rows_; ++row) {
        double rowSum = 0.0;
        for (int column = 0; column < columns_; ++column) {
            double cell = 0.0;
            for (int i = 0; i < samplesDown * samplesAcross; ++i) {
                const glm::dvec3& power =
                    sky.at(samplesDown * row + i / samplesAcross, samplesAcross * column + i % samplesAcross)
                        .power;
                cell += std::max(0.0, power.r + power.g + power.b);
            }
            cells_.push_back(cell);
            columnEnds_.push_back(rowSum += cell);
        }
        rowEnds_.push_back(total_ += rowSum);
    }
}

double SkyDensity::top(int row) const {
    return std::cos(pi * row / rows_);
}

glm::dvec3 SkyDensity::direction(const glm::dvec2& u) const {
    const Chosen row = choose(rowEnds_, u.x);
    const std::span<const double> ends(columnEnds_.data() + std::size_t(row.index) * std::size_t(columns_),
                                       std::size_t(columns_));
    const Chosen column = choose(ends, u.y);
    const double y = top(row.index) + (top(row.index + 1) - top(row.index)) * row.within;
    return skyDirection(y, 2.0 * pi * (column.index + column.within) / columns_ - pi);
}

double SkyDensity::at(const glm::dvec3& d) const {
    if (isBlack()) return 0.0;
    const glm::dvec2 uv = latLongUv(d);
    const int row = std::min(int(uv.y * rows_), rows_ - 1);
    const int column = std::min(int(uv.x * columns_), columns_ - 1);
    const double solidAngle = (top(row) - top(row + 1)) * 2.0 * pi / columns_;
    return cells_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)] / (total_ * solidAngle);
}

}  // namespace penumbra
