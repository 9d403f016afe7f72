#include "assets/make/shapes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>

namespace penumbra::assets {
namespace {

Ring rectangleRing(const Vec3& lower, const Vec3& upper, double y) {
    return {{lower.x, y, upper.z}, {upper.x, y, upper.z}, {upper.x, y, lower.z}, {lower.x, y, lower.z}};
}

// Any unit vector perpendicular to `direction`.
Vec3 perpendicular(const Vec3& direction) {
    const Vec3 other = std::abs(direction.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    return glm::normalize(glm::cross(direction, other));
}

// Turns `vector` by the smallest rotation that takes unit `from` to unit `to`: carries a frame along without
// twist.
Vec3 carried(const Vec3& vector, const Vec3& from, const Vec3& to) {
    const Vec3 axis = glm::cross(from, to);
    const double cosine = glm::dot(from, to);
    if (cosine < -0.999999) return vector;
    return vector * cosine + glm::cross(axis, vector) + axis * (glm::dot(axis, vector) / (1.0 + cosine));
}

std::vector<Vec3> tangents(const std::vector<Vec3>& curve, bool loop) {
    const std::size_t n = curve.size();
    std::vector<Vec3> result(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = i > 0 ? i - 1 : (loop ? n - 1 : 0);
        const std::size_t after = i + 1 < n ? i + 1 : (loop ? 0 : n - 1);
        result[i] = glm::normalize(curve[after] - curve[before]);
    }
    return result;
}

}  // namespace

Mesh loft(const std::vector<Ring>& rings, bool joinEnds) {
    Mesh mesh;
    const auto n = static_cast<std::uint32_t>(rings.front().size());
    const auto count = static_cast<std::uint32_t>(rings.size());
    for (const Ring& ring : rings) mesh.positions.insert(mesh.positions.end(), ring.begin(), ring.end());
    for (std::uint32_t i = 0; i + (joinEnds ? 0 : 1) < count; ++i) {
        const std::uint32_t low = i * n, high = (i + 1) % count * n;
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t k = (j + 1) % n;
            mesh.triangles.push_back({low + j, low + k, high + k});
            mesh.triangles.push_back({low + j, high + k, high + j});
        }
    }
    if (joinEnds) return mesh;
    const std::uint32_t last = (count - 1) * n;
    for (std::uint32_t j = 1; j + 1 < n; ++j) {
        mesh.triangles.push_back({0, j + 1, j});
        mesh.triangles.push_back({last, last + j, last + j + 1});
    }
    return mesh;
}

Mesh box(const Vec3& lower, const Vec3& upper) {
    return loft({rectangleRing(lower, upper, lower.y), rectangleRing(lower, upper, upper.y)});
}

Mesh chamferedBox(const Vec3& lower, const Vec3& upper, double chamfer) {
    const Vec3 inset(chamfer, 0.0, chamfer);
    return loft({rectangleRing(lower, upper, lower.y), rectangleRing(lower, upper, upper.y - chamfer),
                 rectangleRing(lower + inset, upper - inset, upper.y)});
}

Mesh lathe(const std::vector<Vec2>& profile, int segments, bool loop) {
    std::vector<Ring> rings;
    for (const Vec2& p : profile) {
        Ring ring;
        for (int j = 0; j < segments; ++j) {
            const double angle = glm::two_pi<double>() * j / segments;
            ring.emplace_back(p.x * std::cos(angle), p.y, -p.x * std::sin(angle));
        }
        rings.push_back(ring);
    }
    return welded(loft(rings, loop));
}

Mesh sphere(double radius, int subdivisions) {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    Mesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int s = 0; s < subdivisions; ++s) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto next = static_cast<std::uint32_t>(mesh.positions.size());
            const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), next);
            if (isNew) mesh.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
            return entry->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : mesh.triangles) {
            const std::uint32_t a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
            finer.insert(finer.end(), {{t.x, a, c}, {t.y, b, a}, {t.z, c, b}, {a, b, c}});
        }
        mesh.triangles = finer;
        for (Vec3& p : mesh.positions) p = glm::normalize(p);
    }
    for (Vec3& p : mesh.positions) p = radius * glm::normalize(p);
    return mesh;
}

Mesh tube(const std::vector<Vec3>& curve, const std::vector<double>& radius, int segments, bool joinEnds) {
    const std::vector<Vec3> tangent = tangents(curve, joinEnds);
    std::vector<Vec3> side{perpendicular(tangent[0])};
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const Vec3 v = carried(side.back(), tangent[i - 1], tangent[i]);
        side.push_back(glm::normalize(v - tangent[i] * glm::dot(v, tangent[i])));
    }
    // Around a loop the frame comes back turned by some angle; spread it over the loop, or the seam would be
    // twisted.
    double mismatch = 0.0;
    if (joinEnds) {
        const Vec3 back = carried(side.back(), tangent.back(), tangent[0]);
        mismatch = std::atan2(glm::dot(glm::cross(back, side[0]), tangent[0]), glm::dot(back, side[0]));
    }
    std::vector<Ring> rings;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const Vec3 other = glm::cross(tangent[i], side[i]);
        const double turn = mismatch * static_cast<double>(i) / static_cast<double>(curve.size());
        const double r = radius.size() == 1 ? radius[0] : radius[i];
        Ring ring;
        for (int j = 0; j < segments; ++j) {
            const double angle = glm::two_pi<double>() * j / segments + turn;
            ring.push_back(curve[i] + r * (std::cos(angle) * side[i] + std::sin(angle) * other));
        }
        rings.push_back(ring);
    }
    return loft(rings, joinEnds);
}

Mesh bar(const Vec3& from, const Vec3& to, double radius, int segments) {
    return tube({from, to}, {radius}, segments);
}

Mesh extrude(const Polygon& polygon, double zLow, double zHigh, int slices) {
    Mesh mesh;
    const auto n = static_cast<std::uint32_t>(polygon.size());
    for (int s = 0; s <= slices; ++s)
        for (const Vec2& p : polygon) mesh.positions.emplace_back(p, zLow + (zHigh - zLow) * s / slices);
    const std::uint32_t last = n * static_cast<std::uint32_t>(slices);
    for (const glm::uvec3& t : triangulate(polygon)) {
        mesh.triangles.push_back(t + last);
        mesh.triangles.push_back({t.x, t.z, t.y});
    }
    for (std::uint32_t low = 0; low < last; low += n)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t j = (i + 1) % n;
            mesh.triangles.push_back({low + i, low + j, low + j + n});
            mesh.triangles.push_back({low + i, low + j + n, low + i + n});
        }
    return mesh;
}

std::vector<Vec3> smoothCurve(const std::vector<Vec3>& control, int perSpan) {
    std::vector<Vec3> result;
    const std::size_t n = control.size();
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const Vec3 p0 = control[i > 0 ? i - 1 : 0], p1 = control[i];
        const Vec3 p2 = control[i + 1], p3 = control[i + 2 < n ? i + 2 : n - 1];
        for (int k = 0; k < perSpan; ++k) {
            const double t = static_cast<double>(k) / perSpan;
            result.push_back(0.5 * (2.0 * p1 + (p2 - p0) * t + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * t * t +
                                    (3.0 * p1 - p0 - 3.0 * p2 + p3) * t * t * t));
        }
    }
    result.push_back(control.back());
    return result;
}

Mesh openQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    Mesh mesh;
    mesh.quad(a, b, c, d);
    return mesh;
}

}  // namespace penumbra::assets
