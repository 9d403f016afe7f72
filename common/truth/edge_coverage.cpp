#include "common/truth/edge_coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

double hardTest(double distance) {
    return distance > 0.0 ? 1.0 : distance < 0.0 ? 0.0 : 0.5;
}

}  // namespace

double diskCoverage(double distance, double radius) {
    if (!(radius > 0.0)) return hardTest(distance);
    const double u = std::clamp(distance / radius, -1.0, 1.0);
    return 1.0 - (std::acos(u) - u * std::sqrt(1.0 - u * u)) / std::numbers::pi;
}

double boxCoverage(double distance, double width, const glm::dvec2& edgeNormal) {
    if (!(width > 0.0)) return hardTest(distance);
    const glm::dvec2 widths = width * glm::abs(edgeNormal) / glm::length(edgeNormal);
    const double a = std::max(widths.x, widths.y);
    const double b = std::min(widths.x, widths.y);
    // By symmetry for |distance|: linear in the middle, a parabola where a corner of the box is cut off, then
    // constant.
    const double d = std::abs(distance);
    double lit = 1.0;
    if (d <= 0.5 * (a - b)) {
        lit = 0.5 + d / a;
    } else if (d < 0.5 * (a + b)) {
        const double rest = 0.5 * (a + b) - d;
        lit = 1.0 - rest * rest / (2.0 * a * b);
    }
    return distance < 0.0 ? 1.0 - lit : lit;
}

double bilinearCompareRamp(double distance, int k) {
    return std::clamp(0.5 + distance / (2 * k + 1), 0.0, 1.0);
}

double bilinearCompareWeight(double offset, int k) {
    return std::clamp(k + 1 - std::abs(offset), 0.0, 1.0) / (2 * k + 1);
}

double blobCoverage(double blobRadius, double radius) {
    const double a = std::min(1.0, blobRadius / radius);
    return 1.0 - a * a;
}

double barCoverage(double halfWidth, double radius) {
    const double h = std::min(1.0, halfWidth / radius);
    return 1.0 - 2.0 * (h * std::sqrt(1.0 - h * h) + std::asin(h)) / std::numbers::pi;
}

}  // namespace penumbra
