// Directions in proportion to how bright the sky is there.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "chapters/11_bent_normals/sky_samples.h"

namespace penumbra {

/// A density over the sphere that is constant in each of 256 x 256 cells and proportional to the mean of the
/// sky's channels there: a sun is hit by half of the rays where a cosine would find it with one in five
/// hundred.
class SkyDensity {
 public:
    explicit SkyDensity(const SkySamples& sky);
    /// A sky that is black everywhere has no density, and nothing to be found.
    bool isBlack() const { return total_ == 0.0; }
    /// The direction of a point of the unit square. Not of a black sky.
    glm::dvec3 direction(const glm::dvec2& u) const;
    /// Its density, per steradian.
    double at(const glm::dvec3& direction) const;
    /// Brightness times solid angle of each cell, row by row: what the density depends on.
    const std::vector<double>& cells() const { return cells_; }

 private:
    double top(int row) const;  ///< height of a row's upper border

    int rows_, columns_;
    double total_ = 0.0;
    std::vector<double> cells_, rowEnds_, columnEnds_;  ///< running sums of rows, and within each row
};

}  // namespace penumbra
