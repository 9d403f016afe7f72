// The defining integrals of ambient visibility, without closed forms: a hemisphere is cut into meridians, and
// of each meridian a situation says only which stretch of it is a hole or an obstacle.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "common/truth/ambient_forms.h"

namespace penumbra {

/// Calls use(x, weight) at the nodes of the tanh-sinh rule on [a, b], which is at ease with square roots at
/// either end (Takahasi & Mori 1974, Publ. RIMS 9).
template <class Use>
void integrate(double a, double b, const Use& use) {
    if (!(a < b)) return;
    constexpr double step = 1.0 / 14.0, half = std::numbers::pi / 2.0;
    for (int i = -46; i <= 46; ++i) {
        const double inner = half * std::sinh(step * i);
        const double rest = 1.0 / (std::exp(std::abs(inner)) * std::cosh(inner));  // 1 - |tanh|
        const double x = i < 0 ? a + 0.5 * (b - a) * rest : b - 0.5 * (b - a) * rest;
        const double cosh = std::cosh(inner);
        use(x, 0.5 * (b - a) * step * half * std::cosh(step * i) / (cosh * cosh));
    }
}

/// A hemisphere about +z by meridians: from angle `stretch(phi).first` to `.second` from the normal the sky
/// is `within` open, elsewhere `outside`.
struct Meridians {
    std::function<std::pair<double, double>(double phi)> stretch;
    std::function<double(const glm::dvec3& w)> within = [](const glm::dvec3&) { return 0.0; };
    double outside = 1.0;
    /// What shines there: then pi times `cosine` of the result is irradiance.
    std::function<double(const glm::dvec3& w)> radiance = [](const glm::dvec3&) { return 1.0; };
    std::vector<double> breaks;  ///< azimuths where the stretch begins, ends or has a kink; any range
};

inline void addDirection(AmbientForm& form, const glm::dvec3& w, double weight) {
    form.cosine += weight * w.z / std::numbers::pi;
    form.cosineBent += weight * w.z / std::numbers::pi * w;
    form.uniform += weight / (2.0 * std::numbers::pi);
    form.uniformBent += weight / (2.0 * std::numbers::pi) * w;
}

inline AmbientForm zeroForm() {
    return {0.0, 0.0, glm::dvec3(0.0), glm::dvec3(0.0)};
}

inline AmbientForm quadrature(const Meridians& sky) {
    constexpr double whole = 2.0 * std::numbers::pi, horizon = std::numbers::pi / 2.0;
    std::vector<double> cuts{0.0, whole};
    for (const double cut : sky.breaks) cuts.push_back(cut - whole * std::floor(cut / whole));
    std::sort(cuts.begin(), cuts.end());
    AmbientForm form = zeroForm();
    const auto along = [&](double phi, double width, double from, double to, bool within) {
        integrate(from, to, [&](double theta, double weight) {
            const double s = std::sin(theta);
            const glm::dvec3 w(s * std::cos(phi), s * std::sin(phi), std::cos(theta));
            addDirection(form, w,
                         width * weight * s * sky.radiance(w) * (within ? sky.within(w) : sky.outside));
        });
    };
    for (std::size_t i = 1; i < cuts.size(); ++i)
        integrate(cuts[i - 1], cuts[i], [&](double phi, double width) {
            auto [from, to] = sky.stretch(phi);
            from = std::clamp(from, 0.0, horizon);
            to = std::clamp(to, from, horizon);
            along(phi, width, 0.0, from, false);
            along(phi, width, from, to, true);
            along(phi, width, to, horizon, false);
        });
    return form;
}

/// The largest of the eight differences.
inline double difference(const AmbientForm& a, const AmbientForm& b) {
    const glm::dvec3 cosine = glm::abs(a.cosineBent - b.cosineBent);
    const glm::dvec3 uniform = glm::abs(a.uniformBent - b.uniformBent);
    return std::max({std::abs(a.cosine - b.cosine), std::abs(a.uniform - b.uniform), cosine.x, cosine.y,
                     cosine.z, uniform.x, uniform.y, uniform.z});
}

/// Angle from the normal, in degrees.
inline double lean(const glm::dvec3& bent) {
    return std::atan2(std::hypot(bent.x, bent.y), bent.z) * 180.0 / std::numbers::pi;
}

}  // namespace penumbra
