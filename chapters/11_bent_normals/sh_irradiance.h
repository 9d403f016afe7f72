// Irradiance of a sky as a quadratic polynomial of the normal: spherical harmonics of order 2.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "chapters/11_bent_normals/sky_samples.h"

namespace penumbra {

/// The nine spherical harmonics Y_lm, l <= 2, at a unit direction, orthonormal on the sphere: 00, then 1-1,
/// 10, 11 (along y, z, x), then 2-2, 2-1, 20, 21, 22.
std::array<double, 9> sphericalHarmonics(const glm::dvec3& direction);

/// E(n) = sum A_l L_lm Y_lm(n) with A = pi, 2 pi / 3, pi / 4 (Ramamoorthi & Hanrahan, "An Efficient
/// Representation for Irradiance Environment Maps", 2001, SIGGRAPH). Exact for a sky of order 2 or less; for
/// one small lamp wrong by up to 9.4 % of the peak.
struct ShIrradiance {
    /// A_l L_lm, in the order of sphericalHarmonics, linear RGB.
    std::array<glm::dvec3, 9> coefficients{};

    static ShIrradiance of(const SkySamples& sky);
    /// Factors of 1, y, z, x, xy, yz, 3zz - 1, xz and xx - yy: E(n) as a shader wants it.
    std::array<glm::dvec3, 9> polynomial() const;
    /// Irradiance on an unoccluded plane with unit normal `n`; what falls below 0 (the polynomial can, behind
    /// a small lamp) is 0.
    glm::dvec3 at(const glm::dvec3& n) const;
};

/// The linear sky nearest to a sky, L(w) = mean + gradient * w: its order 0 and 1. With the unnormalised pair
/// of chapter 09, E = pi (mean A + gradient Bc), whatever the occluders.
struct LinearSky {
    glm::dvec3 mean{0.0};
    glm::dmat3 gradient{0.0};  ///< columns x, y, z

    static LinearSky of(const SkySamples& sky);
    /// `visibility`, `bent`: cosine-weighted, `bent` NOT normalised. Negative values, which a fitted sky can
    /// give, are 0.
    glm::dvec3 irradiance(double visibility, const glm::dvec3& bent) const;
};

}  // namespace penumbra
