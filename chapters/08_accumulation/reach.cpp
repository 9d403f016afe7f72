#include "chapters/08_accumulation/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "chapters/08_accumulation/projection.h"
#include "common/math/magnitude.h"

namespace penumbra {

namespace {

constexpr double relativeSlack = 1e-9;

Polygon3 flipped(const Polygon3& polygon) {
    Polygon3 result;
    for (int i = polygon.count - 1; i >= 0; --i) result.push(polygon[i]);
    return result;
}

}  // namespace

Reach::Reach(const Receiver& receiver, const Light& light)
    : Reach(receiver.corners(), receiver.normal, light) {}

Reach::Reach(std::span<const glm::dvec3> area, const glm::dvec3& normal, const Light& light) {
    const Polygon3 whole(area);
    for (const glm::dvec3& p : area) scale_ = std::max(scale_, sumOfMagnitudes(p));
    if (light.type == LightType::directional) {
        if (glm::dot(normal, light.direction) < 0.0) addDirection(whole, normal, -light.direction, false);
        return;
    }
    if (light.type != LightType::area) {
        if (glm::dot(normal, light.position - area[0]) > 0.0)
            addDirection(whole, normal, light.position, true);
        return;
    }
    for (const auto& polygon : light.polygons) {
        const Polygon3 above =
            clip(Polygon3(polygon), [&](const glm::dvec3& p) { return glm::dot(normal, p - area[0]); });
        const Polygon3 seen =
            clip(whole, [&](const glm::dvec3& p) { return glm::dot(light.direction, p - polygon[0]); });
        if (!above.empty() && !seen.empty()) addPolygon(seen, normal, above);
    }
}

void Reach::add(const glm::dvec3& inward, const glm::dvec3& point, double slack) {
    planes_.push_back({inward, point, slack});
}

/// The planes added since `groupStart` become a group of the last piece.
void Reach::close(std::uint32_t groupStart) {
    const auto count = std::uint32_t(planes_.size()) - groupStart;
    if (count == 0) return;
    groups_.push_back({groupStart, count});
    ++pieces_.back().count;
}

void Reach::addPolygon(const Polygon3& area, const glm::dvec3& normal, const Polygon3& light) {
    for (const glm::dvec3& p : light.span()) scale_ = std::max(scale_, sumOfMagnitudes(p));
    const double slack = relativeSlack * scale_;
    pieces_.push_back({std::uint32_t(groups_.size()), 0, area, light});
    // Above the receiver, by more than the floats of a flat surface are off their plane.
    auto start = std::uint32_t(planes_.size());
    add(normal, area[0], -2.0 * 0x1p-24 * scale_);
    close(start);
    const glm::dvec3 front = glm::normalize(areaNormal(light.span()));
    start = std::uint32_t(planes_.size());
    add(front, light[0], slack);
    close(start);
    for (int i = 0; i < light.count; ++i) {
        start = std::uint32_t(planes_.size());
        for (const glm::dvec3& x : area.span()) {
            const glm::dvec3 a = light[i] - x, b = light[light.next(i)] - x;
            const glm::dvec3 across = glm::cross(b, a);
            const double length = glm::length(across);
            // Seen end on, the edge spans no plane: it decides nothing.
            if (length <= 1e-6 * glm::length(a) * glm::length(b)) {
                planes_.resize(start);
                break;
            }
            add(across / length, x, slack);
        }
        close(start);
    }
}

/// A light without an area: the planes through the area's edges, which run counter-clockwise about `normal`.
void Reach::addDirection(const Polygon3& area, const glm::dvec3& normal, const glm::dvec3& toLight,
                         bool isPoint) {
    if (isPoint) scale_ = std::max(scale_, sumOfMagnitudes(toLight));
    const Polygon3 outline = glm::dot(areaNormal(area.span()), normal) > 0.0 ? area : flipped(area);
    pieces_.push_back({std::uint32_t(groups_.size()), 0, area, {}});
    auto start = std::uint32_t(planes_.size());
    add(normal, area[0], -2.0 * 0x1p-24 * scale_);
    close(start);
    if (isPoint) {
        start = std::uint32_t(planes_.size());
        add(-normal, toLight, relativeSlack * scale_);
        close(start);
    }
    for (int i = 0; i < outline.count; ++i) {
        const glm::dvec3 along = outline[outline.next(i)] - outline[i];
        const glm::dvec3 inward = glm::cross(isPoint ? toLight - outline[i] : toLight, along);
        const double length = glm::length(inward);
        if (!(length > 0.0)) continue;
        start = std::uint32_t(planes_.size());
        add(inward / length, outline[i], relativeSlack * scale_);
        close(start);
    }
}

/// `outside(plane)`: wholly on the outer side.
template <class Outside>
bool Reach::missesPlanes(const Piece& piece, const Outside& outside) const {
    const auto outsideGroup = [&](const Group& group) {
        for (std::uint32_t i = group.first; i < group.first + group.count; ++i)
            if (!outside(planes_[i])) return false;
        return true;
    };
    for (std::uint32_t i = piece.first; i < piece.first + piece.count; ++i)
        if (outsideGroup(groups_[i])) return true;
    return false;
}

bool Reach::passesAnEdge(const Piece& piece, const Triangle& t, double slack) const {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const auto side = [&](const glm::dvec3& x) { return glm::dot(normal, t[0] - x); };
    const double sign = side(piece.area[0]) > 0.0 ? 1.0 : -1.0;
    const double flat = slack * sumOfMagnitudes(normal);
    for (const glm::dvec3& x : piece.area.span())
        if (sign * side(x) <= flat)
            return false;  // its plane cuts the area: no edge is the same from all sides
    const auto isOutside = [&](const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 inward = sign * glm::cross(a - x, b - x);
        const double limit = -slack * sumOfMagnitudes(inward);
        for (const glm::dvec3& p : piece.light.span())
            if (glm::dot(inward, p - x) >= limit) return false;
        return true;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        bool all = true;
        for (int i = 0; i < piece.area.count && all; ++i)
            all = isOutside(piece.area[i], t[k], t[(k + 1) % 3]);
        if (all) return true;
    }
    return false;
}

bool Reach::misses(const Aabb& box) const {
    if (box.empty()) return true;
    const glm::dvec3 centre = box.centre(), half = 0.5 * box.size();
    const double slack = relativeSlack * (sumOfMagnitudes(centre) + sumOfMagnitudes(half));
    const auto outside = [&](const Plane& plane) {
        const double nearest =
            glm::dot(plane.inward, centre - plane.point) + glm::dot(glm::abs(plane.inward), half);
        return nearest < -plane.slack - (plane.slack < 0.0 ? 0.0 : slack);
    };
    return std::all_of(pieces_.begin(), pieces_.end(),
                       [&](const Piece& piece) { return missesPlanes(piece, outside); });
}

bool Reach::misses(const Triangle& t) const {
    const double slack =
        relativeSlack * std::max({sumOfMagnitudes(t[0]), sumOfMagnitudes(t[1]), sumOfMagnitudes(t[2])});
    const auto outside = [&](const Plane& plane) {
        const double limit = -plane.slack - (plane.slack < 0.0 ? 0.0 : slack);
        return glm::dot(plane.inward, t[0] - plane.point) < limit &&
               glm::dot(plane.inward, t[1] - plane.point) < limit &&
               glm::dot(plane.inward, t[2] - plane.point) < limit;
    };
    return std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
        return missesPlanes(piece, outside) ||
               (!piece.light.empty() && passesAnEdge(piece, t, slack + relativeSlack * scale_));
    });
}

namespace {

Triangle triangleOf(const Scene& scene, std::uint32_t triangle) {
    const std::uint32_t* corner = &scene.indices[3 * std::size_t(triangle)];
    return {scene.positions[corner[0]], scene.positions[corner[1]], scene.positions[corner[2]]};
}

/// The least height of the light's points that shine on the receiver; 0 if it reaches down to its plane.
double lowestLight(const Receiver& receiver, const Light& light) {
    if (light.type != LightType::area) return std::max(0.0, receiver.height(light.position));
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& polygon : light.polygons)
        for (const glm::dvec3& p : polygon) lowest = std::min(lowest, receiver.height(p));
    return std::max(0.0, lowest);
}

}  // namespace

Occluders occludersBetween(const Scene& scene, const Receiver& receiver, const Light& light) {
    Occluders found;
    const Reach reach(receiver, light);
    if (reach.empty()) return found;
    for (std::uint32_t c = 0; c < scene.clusters.size(); ++c) {
        const Cluster& cluster = scene.clusters[c];
        if (int(cluster.part) == light.part || reach.misses(cluster.bounds)) continue;
        const std::size_t before = found.reaching.size();
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount;
             ++t) {
            const Triangle triangle = triangleOf(scene, t);
            if (std::binary_search(receiver.triangles.begin(), receiver.triangles.end(), t) ||
                reach.misses(triangle))
                continue;
            found.reaching.push_back(triangle);
            for (const glm::dvec3& p : triangle) found.highest = std::max(found.highest, receiver.height(p));
        }
        if (found.reaching.size() == before) continue;
        found.clusters.clusters.push_back(c);
        found.clusters.triangles += cluster.triangleCount;
    }
    if (light.type != LightType::directional) {
        const double lowest = lowestLight(receiver, light);
        const double smallest = lowest > found.highest ? 1.0 - found.highest / lowest : 0.0;
        found.near = std::clamp(0.9 * smallest, nearestFraction, 0.5);
    }
    return found;
}

}  // namespace penumbra
