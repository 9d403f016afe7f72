#include "chapters/09_ambient_occlusion/vertex_bake_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "chapters/09_ambient_occlusion/least_squares.h"
#include "common/math/hemisphere.h"
#include "common/math/sampling.h"
#include "common/truth/shadow_packet.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

namespace {

/// Every third bit of the result is a bit of `v` (21 of them).
std::uint64_t spread(std::uint64_t v) {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    return (v | v << 2) & 0x1249249249249249;
}

/// Exact, and a total order: for finding equal ones. -0 is made 0 first.
std::array<std::uint32_t, 6> keyOf(const glm::vec3& p, const glm::vec3& n) {
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v + 0.0f); };
    return {bits(p.x), bits(p.y), bits(p.z), bits(n.x), bits(n.y), bits(n.z)};
}

/// What was asked for, before equal ones are merged.
struct Asked {
    std::vector<glm::vec3> positions, normals;
};

/// Sorts and merges; leaves the triangles to the caller.
BakePoints sortedAndMerged(const Asked& asked, const Aabb& bounds) {
    const std::size_t count = asked.positions.size();
    std::vector<std::uint64_t> codes(count);
    for (std::size_t i = 0; i < count; ++i) codes[i] = mortonCode(glm::dvec3(asked.positions[i]), bounds);
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (codes[a] != codes[b]) return codes[a] < codes[b];
        return keyOf(asked.positions[a], asked.normals[a]) < keyOf(asked.positions[b], asked.normals[b]);
    });
    BakePoints result;
    result.pointOf.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        const glm::vec3 &p = asked.positions[order[k]], &n = asked.normals[order[k]];
        const bool isNew =
            k == 0 || keyOf(p, n) != keyOf(asked.positions[order[k - 1]], asked.normals[order[k - 1]]);
        if (isNew) result.points.push_back({p, n});
        result.pointOf[order[k]] = std::uint32_t(result.points.size() - 1);
    }
    return result;
}

// How far into a triangle rays begin, as a part of the way to its centroid: enough to be safely inside, and
// too little to see anything else.
constexpr double inside = 1e-3;

/// How far above it, metres.
double liftOf(double reach) {
    return 16.0 * 0x1p-23 * reach;
}

/// The angle of (x, y) without a root or an arc tangent, and growing as it does: -1 to 3 once around.
float diamondAngle(float x, float y) {
    const float size = std::abs(x) + std::abs(y);
    const float part = size > 0.0f ? y / size : 0.0f;
    return x >= 0.0f ? part : 2.0f - part;
}

}  // namespace

std::uint64_t mortonCode(const glm::dvec3& p, const Aabb& bounds) {
    const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    const glm::dvec3 cell = (p - bounds.lower) * (longest > 0.0 ? 2097151.0 / longest : 0.0);
    return spread(std::uint64_t(cell.x)) | spread(std::uint64_t(cell.y)) << 1 |
           spread(std::uint64_t(cell.z)) << 2;
}

std::size_t BakePoints::bytes() const {
    return points.size() * sizeof(BakePoint) + (pointOf.size() + triangles.size()) * sizeof(std::uint32_t);
}

BakePoints vertexPoints(const Scene& scene) {
    BakePoints result = sortedAndMerged({scene.positions, scene.normals}, scene.bounds);
    for (const std::uint32_t vertex : scene.indices) ++result.points[result.pointOf[vertex]].triangleCount;
    std::uint32_t first = 0;
    for (BakePoint& point : result.points) {
        point.firstTriangle = first;
        first += point.triangleCount;
        point.triangleCount = 0;
    }
    result.triangles.resize(first);
    for (std::size_t i = 0; i < scene.indices.size(); ++i) {
        BakePoint& point = result.points[result.pointOf[scene.indices[i]]];
        result.triangles[point.firstTriangle + point.triangleCount++] = std::uint32_t(i / 3);
    }
    return result;
}

BakePoints trianglePoints(const Scene& scene) {
    Asked asked;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
        const auto [a, b, c] = cornersOf(scene, t);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        asked.positions.emplace_back((a + b + c) / 3.0);
        asked.normals.emplace_back(length > 0.0 ? normal / length : glm::dvec3(0.0));
    }
    BakePoints result = sortedAndMerged(asked, scene.bounds);
    result.triangles.resize(result.points.size());
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
        const std::uint32_t point = result.pointOf[t];
        result.points[point].firstTriangle = point;
        result.points[point].triangleCount = 1;
        result.points[point].corner = false;
        result.triangles[point] = t;
    }
    return result;
}

BakePoints spreadPoints(const Scene& scene, int perTriangle, std::uint32_t seed) {
    BakePoints result;
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
        for (int k = 0; k < perTriangle; ++k) {
            const Hit hit = surfaceHit(scene, t, stratifiedBarycentric(k, hashSeed(t, seed)));
            const bool turnedOver = !(glm::dot(hit.shadingNormal, hit.geometricNormal) > 0.0);
            const auto index = std::uint32_t(result.points.size());
            result.points.push_back({glm::vec3(hit.position),
                                     glm::vec3(turnedOver ? hit.geometricNormal : hit.shadingNormal), index,
                                     1, false});
            result.triangles.push_back(t);
            result.pointOf.push_back(index);
        }
    return result;
}

double tangentTolerance(double reach) {
    return 0.5 * liftOf(reach);
}

double startDistance(const Scene& scene, const BakePoints& points, const BakePoint& point, double reach) {
    double farthest = 0.0;
    for (const std::uint32_t t : points.trianglesOf(point))
        for (const glm::dvec3& corner : cornersOf(scene, t))
            farthest = std::max(farthest, glm::distance(corner, glm::dvec3(point.position)));
    return 2.0 * inside * farthest + 4.0 * liftOf(reach);  // twice: as far down at most, and up again
}

/// One of the point's triangles, and where around the point it lies.
struct PointFan::Wedge {
    float start, end;  ///< diamond angles
    Sector sector;
};

PointFan::PointFan(const Scene& scene, const BakePoints& points, const BakePoint& point, double reach)
    : worldFromLocal_(frameAround(glm::normalize(glm::dvec3(point.normal)))) {
    std::array<Wedge, most> wedges;
    addSectors({wedges.data(), findWedges(scene, points, point, reach, wedges)});
    if (count_ == 0)
        sectors_[count_++] = {
            -1.0f, glm::vec3(0.0f),
            glm::vec3(glm::dvec3(point.position) + liftOf(reach) * glm::dvec3(point.normal))};
    starts_.fill(std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < count_; ++i) starts_[i] = sectors_[i].start;
}

/// In the order of their starts; returns how many they are.
std::size_t PointFan::findWedges(const Scene& scene, const BakePoints& points, const BakePoint& point,
                                 double reach, std::span<Wedge> wedges) const {
    const glm::dvec3 position(point.position), pointNormal(point.normal);
    std::size_t found = 0;
    for (const std::uint32_t t : points.trianglesOf(point)) {
        const auto corners = cornersOf(scene, t);
        const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(glm::dot(cross, pointNormal) > 0.0) || found == most) continue;
        const glm::dvec3 normal = glm::normalize(cross);
        Wedge& wedge = wedges[found++];
        const bool rises = std::ranges::any_of(corners, [&](const glm::dvec3& corner) {
            return glm::dot(pointNormal, corner - position) > tangentTolerance(reach);
        });
        wedge.sector.normal = rises ? glm::vec3(normal) : glm::vec3(0.0f);
        const glm::dvec3 centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
        glm::dvec3 start = inside * (centroid - position) + liftOf(reach) * normal;
        // From below the tangent plane it would meet what only just reaches up to it.
        start += std::max(0.0, liftOf(reach) - glm::dot(pointNormal, start)) * pointNormal;
        wedge.sector.origin = glm::vec3(position + start);
        if (!point.corner) {
            wedge.start = -1.0f, wedge.end = 3.0f;
            continue;
        }
        const auto at = std::find(corners.begin(), corners.end(), position);
        const auto k = std::size_t(at - corners.begin()) % 3;
        const glm::vec3 toNext = glm::vec3(corners[(k + 1) % 3] - position) * worldFromLocal_;
        const glm::vec3 toPrevious = glm::vec3(corners[(k + 2) % 3] - position) * worldFromLocal_;
        wedge.start = diamondAngle(toNext.x, toNext.y);
        wedge.end = diamondAngle(toPrevious.x, toPrevious.y);
        if (wedge.end < wedge.start) wedge.end += 4.0f;
    }
    std::ranges::sort(wedges.first(found), {}, &Wedge::start);
    return found;
}

void PointFan::addSectors(std::span<const Wedge> wedges) {
    const auto addGap = [&](float start, const Wedge& beside) {
        sectors_[count_++] = {start >= 3.0f ? start - 4.0f : start, glm::vec3(0.0f), beside.sector.origin};
    };
    for (std::size_t i = 0; i < wedges.size(); ++i) {
        const Wedge& wedge = wedges[i];
        sectors_[count_] = wedge.sector;
        sectors_[count_++].start = wedge.start;
        const bool last = i + 1 == wedges.size();
        const Wedge& next = wedges[last ? 0 : i + 1];
        const float nextStart = last ? next.start + 4.0f : next.start;
        if (nextStart - wedge.end < 1e-5f) continue;
        // A gap: half of its rays begin over the triangle on one side, half over that on the other.
        addGap(wedge.end, wedge);
        addGap(0.5f * (wedge.end + nextStart), next);
    }
    std::sort(sectors_.begin(), sectors_.begin() + std::ptrdiff_t(count_),
              [](const Sector& a, const Sector& b) { return a.start < b.start; });
}

std::size_t PointFan::sectorOf(const glm::vec3& local) const {
    const float angle = diamondAngle(local.x, local.y);
    // Counted without a branch, many at a time: which sector it is cannot be guessed.
    std::size_t begun = 0;
    for (std::size_t i = 0; i < count_; i += together)
        for (std::size_t k = 0; k < together; ++k) begun += starts_[i + k] <= angle ? 1u : 0u;
    // Before the first start it is still the last sector of the turn.
    return begun == 0 ? count_ - 1 : begun - 1;
}

}  // namespace penumbra
