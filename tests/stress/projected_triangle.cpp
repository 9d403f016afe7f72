#include "tests/stress/projected_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra::stress {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

ProjectedTriangle::ProjectedTriangle(const glm::dmat4& textureFromWorld, const glm::dvec2& size,
                                     const Triangle& triangle, const DrawnOff& off) {
    std::array<glm::dvec3, 3> corner;  // (s q, t q, q), texels
    std::array<double, 3> r{};
    least_ = infinity, most_ = -infinity;
    const double largest = std::max(size.x, size.y);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 strq = textureFromWorld * glm::dvec4(triangle[i], 1.0);
        corner[i] = {strq.x * size.x, strq.y * size.y, strq.w};
        r[i] = strq.z;
        const double q = std::max(strq.w, off.nearest);  // of what is drawn
        const double away = std::max(std::abs(strq.x), std::abs(strq.y)) / q;
        // Transformed, divided, and turned into texels.
        const double rounded = (off.rounding.x + away * off.rounding.z) / q + 0x1p-22 * (1.0 + away);
        margin_ = std::max(margin_, std::sqrt(2.0) * (off.snap + largest * rounded));
        const bool cutOff = strq.w < off.nearest;
        least_ = cutOff ? -infinity : std::min(least_, strq.z / strq.w);
        most_ = cutOff ? infinity : std::max(most_, strq.z / strq.w);
    }
    for (std::size_t i = 0; i < 3; ++i) lines_[i] = glm::cross(corner[(i + 1) % 3], corner[(i + 2) % 3]);
    volume_ = glm::dot(corner[0], lines_[0]);
    if (volume_ < 0.0) {
        volume_ = -volume_;
        for (glm::dvec3& line : lines_) line = -line;
    }
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        depth_ += r[i] * lines_[i];
        const double length = glm::length(glm::dvec2(lines_[i]));
        isLine_ = isLine_ || !(length > 0.0);
        edges_[i] = lines_[i] / length;
        const double q =
            std::max(corner[(i + 1) % 3].z, off.nearest) * std::max(corner[(i + 2) % 3].z, off.nearest);
        longest = std::max(longest, length / q);
    }
    const double q = std::max(corner[0].z, off.nearest) * std::max(corner[1].z, off.nearest) *
                     std::max(corner[2].z, off.nearest);
    slenderness_ = longest * longest * q / volume_;
}

Cover ProjectedTriangle::covers(const glm::dvec2& at) const {
    // Two corners in one place stay there: nothing is drawn. Three in a row may be moved apart.
    if (isLine_) return Cover::no;
    double least = infinity;
    for (const glm::dvec3& edge : edges_) least = std::min(least, glm::dot(edge, glm::dvec3(at, 1.0)));
    if (least > margin_) return Cover::yes;
    return least >= -margin_ ? Cover::maybe : Cover::no;
}

double ProjectedTriangle::distance(const glm::dvec2& at) const {
    double sum = 0.0;
    for (const glm::dvec3& line : lines_) sum += glm::dot(line, glm::dvec3(at, 1.0));
    return volume_ / sum;
}

}  // namespace penumbra::stress
