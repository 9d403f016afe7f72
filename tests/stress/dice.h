// Random numbers of a case's variant: the same on every machine, whatever its standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

namespace penumbra::stress {

class Dice {
 public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    /// In [0, 1).
    double unit() { return double(random_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Every decade as likely as every other.
    double magnitude(double low, double high) { return low * std::pow(high / low, unit()); }
    int below(int count) { return int(unit() * count); }
    bool oneIn(int count) { return below(count) == 0; }
    glm::dvec3 inCube() { return {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)}; }
    glm::dvec3 direction() {
        const double z = between(-1.0, 1.0), angle = 2.0 * std::numbers::pi * unit();
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    /// A unit vector at right angles to `n`.
    glm::dvec3 across(const glm::dvec3& n) { return glm::normalize(glm::cross(n, somethingElse(n))); }

 private:
    glm::dvec3 somethingElse(const glm::dvec3& n) {
        for (;;) {
            const glm::dvec3 d = direction();
            if (std::abs(glm::dot(d, n)) < 0.9 * glm::length(n)) return d;
        }
    }

    std::mt19937_64 random_;
};

}  // namespace penumbra::stress
