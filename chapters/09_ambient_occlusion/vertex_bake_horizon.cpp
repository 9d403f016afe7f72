#include "chapters/09_ambient_occlusion/vertex_bake_horizon.h"

#include <algorithm>
#include <cmath>

#include "common/truth/shadow_packet.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

namespace {

constexpr std::size_t fan = 16;

}  // namespace

struct Horizon::Query {
    glm::dvec3 position, normal;
    double squaredRange = 0.0;

    /// Height of the highest corner of the box above the plane.
    double highest(const Aabb& box) const { return glm::dot(normal, box.farthestAlong(normal) - position); }
    bool withinRange(const Aabb& box) const { return box.squaredDistance(position) < squaredRange; }
};

Horizon::Horizon(const Scene& scene)
    : scene_(scene), reach_(largestCoordinate(scene.bounds)), tolerance_(tangentTolerance(reach_)) {
    sortTriangles();
    chooseScouts();
    std::vector<Aabb> boxes((triangles_.size() + fan - 1) / fan);
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        for (const glm::dvec3& corner : cornersOf(scene, triangles_[i])) boxes[i / fan].extend(corner);
    while (true) {
        levels_.push_back(std::move(boxes));
        const std::vector<Aabb>& below = levels_.back();
        if (below.size() <= fan) break;
        boxes.assign((below.size() + fan - 1) / fan, Aabb());
        for (std::size_t i = 0; i < below.size(); ++i) boxes[i / fan].extend(below[i]);
    }
}

void Horizon::sortTriangles() {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(scene_.triangleCount());
    for (std::uint32_t t = 0; t < keys.size(); ++t) {
        const auto [a, b, c] = cornersOf(scene_, t);
        keys[t] = {mortonCode((a + b + c) / 3.0, scene_.bounds), t};
    }
    std::ranges::sort(keys);
    triangles_.reserve(keys.size());
    for (const auto& [code, t] : keys) triangles_.push_back(t);
}

void Horizon::chooseScouts() {
    constexpr std::size_t many = 64;
    const std::size_t step = std::max<std::size_t>(1, triangles_.size() / many);
    for (std::size_t i = 0; i < triangles_.size(); i += step)
        scouts_.push_back(scene_.positions[scene_.indices[3 * std::size_t(triangles_[i])]]);
}

bool Horizon::anythingAbove(const BakePoints& points, const BakePoint& point, double range) const {
    const glm::dvec3 position(point.position), normal(point.normal);
    // Its own triangles are near enough for any range, and on a rough surface one of them mostly rises.
    for (const std::uint32_t t : points.trianglesOf(point))
        for (const glm::dvec3& corner : cornersOf(scene_, t))
            if (glm::dot(normal, corner - position) > tolerance_) return true;
    if (std::isinf(range))
        for (const glm::vec3& scout : scouts_)
            if (glm::dot(normal, glm::dvec3(scout) - position) > tolerance_) return true;
    const double fromPoint = range + startDistance(scene_, points, point, reach_);
    const Query query{position, normal, fromPoint * fromPoint};
    const std::size_t top = levels_.size() - 1;
    for (std::size_t box = 0; box < levels_[top].size(); ++box)
        if (above(query, top, box)) return true;
    return false;
}

std::size_t Horizon::bytes() const {
    std::size_t boxes = 0;
    for (const std::vector<Aabb>& level : levels_) boxes += level.size();
    return boxes * sizeof(Aabb) + triangles_.size() * sizeof(triangles_[0]);
}

bool Horizon::above(const Query& query, std::size_t level, std::size_t box) const {
    const Aabb& bounds = levels_[level][box];
    if (query.highest(bounds) <= tolerance_ || !query.withinRange(bounds)) return false;
    const std::size_t first = fan * box;
    const std::size_t end =
        std::min(first + fan, level > 0 ? levels_[level - 1].size() : scene_.triangleCount());
    for (std::size_t child = first; child < end; ++child)
        if (level > 0 ? above(query, level - 1, child) : triangleAbove(query, child)) return true;
    return false;
}

bool Horizon::triangleAbove(const Query& query, std::size_t triangle) const {
    Aabb bounds;
    double highest = 0.0;
    for (const glm::dvec3& corner : cornersOf(scene_, triangles_[triangle])) {
        bounds.extend(corner);
        highest = std::max(highest, glm::dot(query.normal, corner - query.position));
    }
    return highest > tolerance_ && query.withinRange(bounds);
}

}  // namespace penumbra
