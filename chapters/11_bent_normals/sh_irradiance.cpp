#include "chapters/11_bent_normals/sh_irradiance.h"

#include <cmath>
#include <numbers>

namespace penumbra {

using std::numbers::pi;

namespace {

// [begin:harmonics]
/// What makes the nine polynomials orthonormal.
const std::array<double, 9>& harmonicFactors() {
    static const double c0 = std::sqrt(1.0 / (4.0 * pi)), c1 = std::sqrt(3.0 / (4.0 * pi));
    static const double c2 = std::sqrt(15.0 / (4.0 * pi)), c20 = std::sqrt(5.0 / (16.0 * pi));
    static const std::array<double, 9> factors{c0, c1, c1, c1, c2, c2, c20, c2, 0.5 * c2};
    return factors;
}

std::array<double, 9> polynomials(const glm::dvec3& d) {
    return {
        1.0, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3.0 * d.z * d.z - 1.0, d.x * d.z, d.x * d.x - d.y * d.y};
}
// [end:harmonics]

}  // namespace

std::array<double, 9> sphericalHarmonics(const glm::dvec3& direction) {
    std::array<double, 9> result = polynomials(direction);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] *= harmonicFactors()[i];
    return result;
}

// [begin:project]
ShIrradiance ShIrradiance::of(const SkySamples& sky) {
    ShIrradiance result;
    for (const SkySample& sample : sky.samples) {
        const std::array<double, 9> y = sphericalHarmonics(sample.direction);
        for (std::size_t i = 0; i < y.size(); ++i) result.coefficients[i] += y[i] * sample.power;
    }
    // What max(0, n.w) leaves of each order. Order 3 is nothing at all, which is why two are enough.
    for (std::size_t i = 0; i < 9; ++i)
        result.coefficients[i] *= i == 0 ? pi : i < 4 ? 2.0 * pi / 3.0 : pi / 4.0;
    return result;
}
// [end:project]

std::array<glm::dvec3, 9> ShIrradiance::polynomial() const {
    std::array<glm::dvec3, 9> result = coefficients;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] *= harmonicFactors()[i];
    return result;
}

glm::dvec3 ShIrradiance::at(const glm::dvec3& n) const {
    const std::array<double, 9> y = sphericalHarmonics(n);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < y.size(); ++i) sum += y[i] * coefficients[i];
    return glm::max(sum, glm::dvec3(0.0));
}

LinearSky LinearSky::of(const SkySamples& sky) {
    LinearSky result;
    for (const SkySample& sample : sky.samples) {
        result.mean += sample.power / (4.0 * pi);
        result.gradient += glm::outerProduct(3.0 / (4.0 * pi) * sample.power, sample.direction);
    }
    return result;
}

// [begin:pair]
glm::dvec3 LinearSky::irradiance(double visibility, const glm::dvec3& bent) const {
    return glm::max(pi * (visibility * mean + gradient * bent), glm::dvec3(0.0));
}
// [end:pair]

}  // namespace penumbra
