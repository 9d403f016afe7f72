// What a texel sees of an area light's points, past sheets whose shadows are polygons: no ray, no drawing.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra {

/// How far inside the shadow that a convex sheet throws from a point of the light a point of the floor lies,
/// metres; negative: so far outside at least of one edge. The floor is y = 0, the sheet above it.
class SheetShadow {
 public:
    SheetShadow(const std::vector<glm::dvec3>& sheet, const glm::dvec3& light) {
        for (const glm::dvec3& corner : sheet) {
            const glm::dvec3 p = light + (corner - light) * light.y / (light.y - corner.y);
            corners_.emplace_back(p.x, p.z);
        }
        for (const glm::dvec2& corner : corners_) middle_ += corner / double(corners_.size());
    }
    double depthOf(const glm::dvec3& p) const {
        double depth = 1e30;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const glm::dvec2 a = corners_[i], along = glm::normalize(corners_[(i + 1) % corners_.size()] - a);
            const auto left = [&](const glm::dvec2& q) {
                return along.x * (q.y - a.y) - along.y * (q.x - a.x);
            };
            depth = std::min(depth, left({p.x, p.z}) * (left(middle_) > 0.0 ? 1.0 : -1.0));
        }
        return depth;
    }

 private:
    std::vector<glm::dvec2> corners_;
    glm::dvec2 middle_{0.0};
};

/// A point of the light, and the shadows that it throws.
struct PointShadows {
    glm::dvec3 position;
    std::vector<SheetShadow> sheets;
};

/// The page's sum V f / sum f at x, or a negative number where some shadow's edge is closer than `margin`.
inline double shareSeen(const std::vector<PointShadows>& points, const glm::dvec3& lightNormal,
                        const glm::dvec3& x, double margin, bool equalWeights) {
    double seen = 0.0, all = 0.0;
    for (const PointShadows& point : points) {
        const glm::dvec3 d = point.position - x;
        const double r2 = glm::dot(d, d);
        const double f = equalWeights ? 1.0 : d.y * -glm::dot(lightNormal, d) / (r2 * r2);
        double deepest = -1e30;
        for (const SheetShadow& sheet : point.sheets) deepest = std::max(deepest, sheet.depthOf(x));
        if (std::abs(deepest) < margin) return -1.0;
        all += f;
        seen += deepest > 0.0 ? 0.0 : f;
    }
    return seen / all;
}

}  // namespace penumbra
