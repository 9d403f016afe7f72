#include "chapters/08_accumulation/flat_polygons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "common/math/polygon.h"

namespace penumbra {

namespace {

/// The triangles of a part over points welded by position.
class Surface {
 public:
    Surface(const Scene& scene, const Part& part) : scene_(scene), first_(part.firstTriangle) {
        const std::size_t count = part.triangleCount;
        const glm::dvec3 size = part.bounds.size();
        const glm::dvec3 far = glm::max(glm::abs(part.bounds.lower), glm::abs(part.bounds.upper));
        tolerance_ = 1e-6 * (glm::length(far) + glm::length(size));
        weld(count);
        for (std::uint32_t t = 0; t < count; ++t) {
            const std::array<glm::dvec3, 3> p = {point(t, 0), point(t, 1), point(t, 2)};
            areaNormals_.push_back(0.5 * areaNormal(p));
        }
        findNeighbours();
    }

    std::uint32_t count() const { return std::uint32_t(areaNormals_.size()); }
    double area(std::uint32_t t) const { return glm::length(areaNormals_[t]); }

    /// The polygon around triangle `seed` of those not `taken` yet, which it takes.
    FlatPolygon grow(std::uint32_t seed, std::vector<bool>& taken) const {
        const glm::dvec3 normal = glm::normalize(areaNormals_[seed]);
        FlatPolygon polygon;
        glm::dvec3 sum(0.0);
        std::vector<std::uint32_t> open = {seed};
        taken[seed] = true;
        while (!open.empty()) {
            const std::uint32_t t = open.back();
            open.pop_back();
            polygon.triangles.push_back(first_ + t);
            sum += areaNormals_[t];
            for (std::size_t k = 0; k < 3; ++k)
                for (const std::uint32_t next : neighbours(t, k))
                    if (!taken[next] && continues(next, point(seed, 0), normal)) {
                        taken[next] = true;
                        open.push_back(next);
                    }
        }
        std::sort(polygon.triangles.begin(), polygon.triangles.end());
        polygon.area = glm::length(sum);
        polygon.normal = sum / polygon.area;
        return polygon;
    }

    /// Has the triangle an area, and its own normal as shading normal?
    bool isFlat(std::uint32_t t) const {
        return area(t) > 0.0 && shadedAlong(t, glm::normalize(areaNormals_[t]));
    }

 private:
    struct Edge {
        std::uint32_t a, b;  ///< welded points, a < b
        std::uint32_t triangle;
    };

    std::uint32_t vertex(std::uint32_t t, std::size_t k) const {
        return scene_.indices[3 * std::size_t(first_ + t) + k];
    }
    glm::dvec3 point(std::uint32_t t, std::size_t k) const { return scene_.positions[vertex(t, k)]; }

    void weld(std::size_t count) {
        std::vector<std::uint32_t> order(3 * count);
        std::iota(order.begin(), order.end(), 0u);
        const auto key = [&](std::uint32_t i) {
            const glm::vec3& p = scene_.positions[vertex(i / 3, i % 3)];
            return std::make_tuple(p.x, p.y, p.z);
        };
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
        welded_.resize(order.size());
        std::uint32_t name = 0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i > 0 && key(order[i - 1]) != key(order[i])) ++name;
            welded_[order[i]] = name;
        }
    }

    Edge edge(std::uint32_t t, std::size_t k) const {
        const std::uint32_t a = welded_[3 * std::size_t(t) + k],
                            b = welded_[3 * std::size_t(t) + (k + 1) % 3];
        return {std::min(a, b), std::max(a, b), t};
    }

    void findNeighbours() {
        for (std::uint32_t t = 0; t < count(); ++t)
            for (std::size_t k = 0; k < 3; ++k) edges_.push_back(edge(t, k));
        std::sort(edges_.begin(), edges_.end(), [](const Edge& p, const Edge& q) {
            return std::tie(p.a, p.b, p.triangle) < std::tie(q.a, q.b, q.triangle);
        });
    }

    /// Triangles at edge `k` of triangle `t`, itself among them.
    std::vector<std::uint32_t> neighbours(std::uint32_t t, std::size_t k) const {
        const Edge shared = edge(t, k);
        const auto [begin, end] = std::equal_range(
            edges_.begin(), edges_.end(), shared,
            [](const Edge& p, const Edge& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
        std::vector<std::uint32_t> found;
        for (auto it = begin; it != end; ++it) found.push_back(it->triangle);
        return found;
    }

    bool shadedAlong(std::uint32_t t, const glm::dvec3& normal) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (glm::length(glm::dvec3(scene_.normals[vertex(t, k)]) - normal) > 1e-3) return false;
        return true;
    }

    /// Does triangle `t` lie in the plane through `origin`, facing along `normal`?
    bool continues(std::uint32_t t, const glm::dvec3& origin, const glm::dvec3& normal) const {
        if (glm::dot(areaNormals_[t], normal) < 0.0 || !shadedAlong(t, normal)) return false;
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(glm::dot(point(t, k) - origin, normal)) > tolerance_) return false;
        return true;
    }

    const Scene& scene_;
    std::uint32_t first_;
    double tolerance_;                     ///< metres off the plane
    std::vector<std::uint32_t> welded_;    ///< per corner: one number for every position
    std::vector<glm::dvec3> areaNormals_;  ///< per triangle: normal times area
    std::vector<Edge> edges_;              ///< sorted
};

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Andrew's monotone chain (A. M. Andrew, Information Processing Letters 1979): indices of the corners,
/// counter-clockwise; corners in the middle of a straight edge left out.
std::vector<std::size_t> convexHull(std::span<const glm::dvec2> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return std::tie(points[i].x, points[i].y) < std::tie(points[j].x, points[j].y);
    });
    std::vector<std::size_t> hull;
    const auto turnsLeft = [&](std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec2 u = points[b] - points[a], v = points[c] - points[b];
        return cross(u, v) > 1e-6 * glm::length(u) * glm::length(v);
    };
    for (int side = 0; side < 2; ++side) {
        const std::size_t base = hull.size();
        for (const std::size_t i : order) {
            while (hull.size() >= base + 2 && !turnsLeft(hull[hull.size() - 2], hull.back(), i))
                hull.pop_back();
            hull.push_back(i);
        }
        hull.pop_back();
        std::reverse(order.begin(), order.end());
    }
    return hull;
}

/// The smallest rectangle around a convex polygon has a side along one of its edges (Freeman & Shapira, CACM
/// 1975). Corner and edges.
std::array<glm::dvec2, 3> smallestRectangle(std::span<const glm::dvec2> hull) {
    std::array<glm::dvec2, 3> best{};
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 u = glm::normalize(hull[(i + 1) % hull.size()] - hull[i]);
        const glm::dvec2 v(-u.y, u.x);
        glm::dvec2 lower(std::numeric_limits<double>::infinity()), upper(-lower);
        for (const glm::dvec2& p : hull) {
            const glm::dvec2 q(glm::dot(u, p), glm::dot(v, p));
            lower = glm::min(lower, q);
            upper = glm::max(upper, q);
        }
        const glm::dvec2 size = upper - lower;
        if (size.x * size.y >= smallest * (1.0 - 1e-9)) continue;
        smallest = size.x * size.y;
        best = {lower.x * u + lower.y * v, size.x * u, size.y * v};
    }
    return best;
}

}  // namespace

std::vector<FlatPolygon> flatPolygons(const Scene& scene, const Part& part, double minimumArea) {
    const Surface surface(scene, part);
    // The largest first: its plane is the most precise one to continue.
    std::vector<std::uint32_t> seeds(surface.count());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::stable_sort(seeds.begin(), seeds.end(),
                     [&](std::uint32_t s, std::uint32_t t) { return surface.area(s) > surface.area(t); });
    std::vector<bool> taken(surface.count(), false);
    std::vector<FlatPolygon> polygons;
    for (const std::uint32_t seed : seeds) {
        if (taken[seed] || !surface.isFlat(seed)) continue;
        FlatPolygon polygon = surface.grow(seed, taken);
        if (polygon.area >= minimumArea) polygons.push_back(std::move(polygon));
    }
    return polygons;
}

std::array<glm::dvec3, 3> parallelogramAround(std::span<const glm::dvec3> points, const glm::dvec3& normal) {
    const glm::dvec3 axis = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, normal)), up = glm::cross(normal, right);
    std::vector<glm::dvec2> plane;
    for (const glm::dvec3& p : points)
        plane.emplace_back(glm::dot(p - points[0], right), glm::dot(p - points[0], up));
    const std::vector<std::size_t> hull = convexHull(plane);
    if (hull.size() == 4) {
        const glm::dvec3 &a = points[hull[0]], &b = points[hull[1]], &c = points[hull[2]],
                         &d = points[hull[3]];
        if (glm::length((a - b) + (c - d)) <= 1e-6 * glm::length(c - a)) return {a, b - a, d - a};
    }
    std::vector<glm::dvec2> outline;
    for (const std::size_t i : hull) outline.push_back(plane[i]);
    const std::array<glm::dvec2, 3> box = smallestRectangle(outline);
    const auto inSpace = [&](const glm::dvec2& v) { return v.x * right + v.y * up; };
    return {points[0] + inSpace(box[0]), inSpace(box[1]), inSpace(box[2])};
}

}  // namespace penumbra
