// A sky as many small lights: the quadrature that irradiance is computed with.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra {

/// Radiance that arrives from a unit direction.
using Radiance = std::function<glm::dvec3(const glm::dvec3& direction)>;

/// The unit direction of height `y` = cos(theta) and longitude `phi`, radians: 0 looks along -z, pi/2 along
/// +x.
glm::dvec3 skyDirection(double y, double phi);

/// A small part of the sky.
struct SkySample {
    glm::dvec3 direction;  ///< unit
    glm::dvec3 power;      ///< radiance times solid angle, linear RGB
};

/// The whole sphere of directions, Y up: rows from the top, columns round the axis, row by row.
struct SkySamples {
    int rows = 0;
    int columns = 0;
    std::vector<SkySample> samples;

    const SkySample& at(int row, int column) const {
        return samples[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
    }
};

/// `bands` belts of equal height in angle, each with two Gauss points in cos(theta), and `columns`
/// equidistant points round the axis. The measure sin(theta) dtheta dphi is part of it: the weights sum to 4
/// pi. A border between belts lies on the horizon, so a sky that ends there is no difficulty. Integrals over
/// skies of spherical harmonics up to order 2, times another of these, are right to 1e-8; a picture is seen
/// at `columns` x 2 `bands` points, so what is smaller than that in it may be missed.
SkySamples sampleSky(const Radiance& radiance, int bands = 256, int columns = 1024);

}  // namespace penumbra
