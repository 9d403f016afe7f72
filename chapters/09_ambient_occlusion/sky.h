// Skies: radiance by direction.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/image/image.h"

namespace penumbra {

/// Radiance that arrives from infinitely far away, by direction (Y is up).
class Sky {
 public:
    /// The same from everywhere, also from below.
    static Sky uniform(const glm::dvec3& radiance);
    /// CIE overcast sky (Moon & Spencer 1942): zenith * (1 + 2 sin(elevation)) / 3, nothing from below; on
    /// open ground E = 7 pi zenith / 9.
    static Sky overcast(const glm::dvec3& zenith);
    /// L(w) = mean + gradient * w per colour channel (columns x, y, z of `gradient`); may be negative
    /// somewhere.
    static Sky linear(const glm::dvec3& mean, const glm::dmat3& gradient);
    /// A latitude-longitude picture, linear values, 3 channels, top row = up, bilinear with wrap-around in
    /// longitude; column u = 0.5 looks along -z and u grows towards +x. Throws Error if it is empty or
    /// holds NaN or negative values.
    static Sky latLong(FloatImage picture);
    /// By name ("uniform", "overcast", "gradient": linear, white above, grey at the horizon, brown below) or
    /// a .hdr/.exr file.
    static Sky named(const std::string& nameOrFile);
    /// The names.
    static const std::vector<std::string>& names();

    /// The same sky, so many times as bright.
    Sky times(double factor) const;
    /// Switched off but for the half around `side`: directions w with side.w >= 0.
    Sky onlySide(const glm::dvec3& side) const;

    glm::dvec3 radiance(const glm::dvec3& direction) const;
    /// Mean radiance as a flat, open ground sees it, E / pi: 1/pi int L (up.w) dw over the upper hemisphere.
    /// By a sum over 512 x 128 cells: 1e-4 for a smooth sky.
    glm::dvec3 onOpenGround() const;

 private:
    struct Model;
    static Sky of(std::function<glm::dvec3(const glm::dvec3& direction)> radiance);
    std::shared_ptr<const Model> model_;
};

/// Where a unit direction lies in a latitude-longitude picture as Sky::latLong takes it: both in [0,1], v = 0
/// up.
glm::dvec2 latLongUv(const glm::dvec3& direction);

}  // namespace penumbra
