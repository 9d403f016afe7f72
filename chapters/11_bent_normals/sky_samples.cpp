#include "chapters/11_bent_normals/sky_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/truth/parallel.h"

namespace penumbra {

namespace {

/// The two Gauss points of [-1, 1]: +-1/sqrt(3), each of weight 1.
constexpr double gaussPoint = 0.57735026918962576451;

}  // namespace

glm::dvec3 skyDirection(double y, double phi) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {sine * std::sin(phi), y, -sine * std::cos(phi)};
}

// [begin:sphere]
SkySamples sampleSky(const Radiance& radiance, int bands, int columns) {
    SkySamples sky{2 * bands, columns, {}};
    sky.samples.resize(std::size_t(sky.rows) * std::size_t(columns));
    const double dPhi = 2.0 * std::numbers::pi / columns;
    parallelRows(sky.rows, [&](int row) {
        const int band = row / 2;
        const double top = std::cos(std::numbers::pi * band / bands);
        const double bottom = std::cos(std::numbers::pi * (band + 1) / bands);
        // In height, sin(theta) dtheta is the difference itself.
        const double halfHeight = 0.5 * (top - bottom);
        const double y = 0.5 * (top + bottom) + (row % 2 == 0 ? gaussPoint : -gaussPoint) * halfHeight;
        for (int column = 0; column < columns; ++column) {
            const glm::dvec3 w = skyDirection(y, (column + 0.5) * dPhi - std::numbers::pi);
            sky.samples[std::size_t(row) * std::size_t(columns) + std::size_t(column)] = {
                w, radiance(w) * (halfHeight * dPhi)};
        }
    });
    return sky;
}
// [end:sphere]

}  // namespace penumbra
