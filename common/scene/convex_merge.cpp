#include "common/scene/convex_merge.h"

#include <algorithm>
#include <map>
#include <utility>

namespace penumbra {
namespace {

/// Sine of the smallest turn that counts as a corner; below, the outline runs straight on (or a hair inwards:
/// rounding).
constexpr double straight = 1e-6;

double turn(std::span<const glm::dvec2> points, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::dvec2 u = points[b] - points[a], v = points[c] - points[b];
    const double lengths = glm::length(u) * glm::length(v);
    return lengths > 0.0 ? (u.x * v.y - u.y * v.x) / lengths : 0.0;
}

/// `polygon` without the corners at which its outline runs straight on.
IndexPolygon corners(std::span<const glm::dvec2> points, const IndexPolygon& polygon) {
    IndexPolygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::uint32_t before = polygon[(i + polygon.size() - 1) % polygon.size()];
        const std::uint32_t after = polygon[(i + 1) % polygon.size()];
        if (turn(points, before, polygon[i], after) > straight) kept.push_back(polygon[i]);
    }
    return kept;
}

bool isConvex(std::span<const glm::dvec2> points, const IndexPolygon& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::uint32_t a = polygon[i];
        const std::uint32_t b = polygon[(i + 1) % polygon.size()], c = polygon[(i + 2) % polygon.size()];
        const double sine = turn(points, a, b, c);
        const bool foldsBack =
            sine <= straight && glm::dot(points[b] - points[a], points[c] - points[b]) < 0.0;
        if (sine < -straight || foldsBack) return false;
    }
    return true;
}

/// The union of two polygons along the run of edges around (a, b), which `p` has in this direction and `q` in
/// the other. Empty if they share all of one of them.
IndexPolygon joined(const IndexPolygon& p, const IndexPolygon& q, std::uint32_t a, std::uint32_t b) {
    const std::size_t n = p.size(), m = q.size();
    std::size_t pBegin = std::size_t(std::find(p.begin(), p.end(), a) - p.begin());
    std::size_t qEnd = std::size_t(std::find(q.begin(), q.end(), a) - q.begin());
    std::size_t pEnd = (pBegin + 1) % n;
    std::size_t qBegin = (qEnd + m - 1) % m;
    if (pBegin == n || qEnd == m || p[pEnd] != b || q[qBegin] != b) return {};
    std::size_t shared = 1;
    while (shared < std::min(n, m) && p[(pEnd + 1) % n] == q[(qBegin + m - 1) % m]) {
        pEnd = (pEnd + 1) % n;
        qBegin = (qBegin + m - 1) % m;
        ++shared;
    }
    while (shared < std::min(n, m) && p[(pBegin + n - 1) % n] == q[(qEnd + 1) % m]) {
        pBegin = (pBegin + n - 1) % n;
        qEnd = (qEnd + 1) % m;
        ++shared;
    }
    if (shared >= std::min(n, m)) return {};
    IndexPolygon result;
    for (std::size_t i = pEnd; i != pBegin; i = (i + 1) % n) result.push_back(p[i]);
    for (std::size_t i = qEnd; i != qBegin; i = (i + 1) % m) result.push_back(q[i]);
    return result;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

class Merger {
 public:
    Merger(std::span<const glm::dvec2> points, std::span<const std::array<std::uint32_t, 3>> triangles)
        : points_(points) {
        for (const auto& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) owner_[{t[k], t[(k + 1) % 3]}] = polygons_.size();
            polygons_.emplace_back(t.begin(), t.end());
        }
    }

    std::vector<IndexPolygon> run(std::size_t maxCorners) {
        bool changed = true;
        while (changed) {
            changed = false;
            for (std::size_t i = 0; i < polygons_.size(); ++i) {
                while (mergeOnce(i, maxCorners)) changed = true;
            }
        }
        std::vector<IndexPolygon> result;
        for (const IndexPolygon& polygon : polygons_) {
            IndexPolygon outline = corners(points_, polygon);
            if (outline.size() >= 3) result.push_back(std::move(outline));
        }
        return result;
    }

 private:
    bool mergeOnce(std::size_t i, std::size_t maxCorners) {
        const IndexPolygon& polygon = polygons_[i];
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const std::uint32_t a = polygon[k], b = polygon[(k + 1) % polygon.size()];
            const auto neighbour = owner_.find({b, a});
            if (neighbour == owner_.end() || neighbour->second == i) continue;
            const std::size_t j = neighbour->second;
            IndexPolygon merged = joined(polygon, polygons_[j], a, b);
            if (merged.size() < 3 || !isConvex(points_, merged) ||
                corners(points_, merged).size() > maxCorners) {
                continue;
            }
            replace(i, j, std::move(merged));
            return true;
        }
        return false;
    }

    void replace(std::size_t i, std::size_t j, IndexPolygon merged) {
        for (const std::size_t old : {i, j}) {
            const IndexPolygon& polygon = polygons_[old];
            for (std::size_t k = 0; k < polygon.size(); ++k)
                owner_.erase({polygon[k], polygon[(k + 1) % polygon.size()]});
        }
        polygons_[j].clear();
        polygons_[i] = std::move(merged);
        const IndexPolygon& polygon = polygons_[i];
        for (std::size_t k = 0; k < polygon.size(); ++k)
            owner_[{polygon[k], polygon[(k + 1) % polygon.size()]}] = i;
    }

    std::span<const glm::dvec2> points_;
    std::vector<IndexPolygon> polygons_;
    std::map<Edge, std::size_t> owner_;  ///< directed edge -> polygon
};

}  // namespace

std::vector<IndexPolygon> mergeConvex(std::span<const glm::dvec2> points,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      std::size_t maxCorners) {
    return Merger(points, triangles).run(maxCorners);
}

}  // namespace penumbra
