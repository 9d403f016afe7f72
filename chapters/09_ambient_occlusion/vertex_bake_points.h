// Where a bake looks at the sky from: the points, without repetition and in an order that keeps neighbours
// together, and what the triangles right around a point hide from it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra {

/// A place on the surface and the normal its hemisphere is about.
struct BakePoint {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    std::uint32_t firstTriangle = 0;  ///< of its triangles, in BakePoints::triangles
    std::uint32_t triangleCount = 0;
    bool corner = true;  ///< it is a vertex of its triangles; false: it lies inside of the only one
};

/// Points in Morton order (G. M. Morton 1966: the bits of the coordinates interleaved), so that rays of one
/// after the other find the hierarchy's nodes in the cache.
struct BakePoints {
    std::vector<BakePoint> points;
    std::vector<std::uint32_t> pointOf;    ///< for each vertex or triangle that was asked for
    std::vector<std::uint32_t> triangles;  ///< see BakePoint::firstTriangle

    std::span<const std::uint32_t> trianglesOf(const BakePoint& point) const {
        return {triangles.data() + point.firstTriangle, point.triangleCount};
    }
    std::size_t bytes() const;
};

/// The bits of the coordinates, interleaved; `p` inside `bounds`, 21 bits for its longest side.
std::uint64_t mortonCode(const glm::dvec3& p, const Aabb& bounds);

/// Every vertex of the scene; those at one position with one normal are one point.
BakePoints vertexPoints(const Scene& scene);
/// The centroid of every triangle, about the triangle's normal.
BakePoints trianglePoints(const Scene& scene);

/// `perTriangle` points spread over every triangle (stratifiedBarycentric), about the interpolated normal:
/// those of triangle t are points [t perTriangle, (t + 1) perTriangle), in no other order.
BakePoints spreadPoints(const Scene& scene, int perTriangle, std::uint32_t seed);

/// What is no higher above a point's tangent plane hides nothing from it, metres: 8 float ulps of `reach`,
/// the scene's largest coordinate. Rays begin at least 16 above.
double tangentTolerance(double reach);
/// At most so far from the point, in metres, do its rays begin (PointFan).
double startDistance(const Scene& scene, const BakePoints& points, const BakePoint& point, double reach);

/// What a point's own triangles do to its rays. From a vertex, rays may pass under one of the triangles that
/// meet there, and no offset along one normal is right for all of them. So the circle around the point is cut
/// into sectors, one for each triangle; a ray that goes out over a triangle begins a little inside of it,
/// 16 float ulps of the scene's largest coordinate above both it and the tangent plane, and is blocked if it
/// goes below it. A convex surface then never shadows itself, at any scale, and a crease shadows itself
/// exactly. With one offset along the vertex normal, one sees dark vertices on coarse balls, and light that
/// leaks in along creases. Two kinds of rays are never blocked here: over a triangle that does not rise above
/// the tangent plane, which Horizon calls nothing as well; and between triangles, beyond the border of the
/// surface or where another normal begins. If the plane of the triangle went on there, one would see dark
/// seams on round things whose normals are split.
class PointFan {
 public:
    /// `reach`: largest coordinate of the scene.
    PointFan(const Scene& scene, const BakePoints& points, const BakePoint& point, double reach);

    /// Frame around the point's normal: columns tangent, bitangent, normal.
    const glm::mat3& worldFromLocal() const { return worldFromLocal_; }
    /// Where a ray in this direction (in the local frame, z > 0) begins; nullptr: it goes below the triangle
    /// over which it goes out.
    const glm::vec3* origin(const glm::vec3& local, const glm::vec3& world) const {
        const Sector& sector = sectors_[sectorOf(local)];
        return glm::dot(sector.normal, world) >= 0.0f ? &sector.origin : nullptr;
    }

 private:
    static constexpr std::size_t together = 8;
    static constexpr std::size_t most = 32;  ///< a fan of more triangles is thinned
    struct Sector {
        float start = 0.0f;      ///< diamond angle, see .cpp
        glm::vec3 normal{0.0f};  ///< 0: nothing below
        glm::vec3 origin{0.0f};
    };
    struct Wedge;

    std::size_t sectorOf(const glm::vec3& local) const;
    std::size_t findWedges(const Scene& scene, const BakePoints& points, const BakePoint& point, double reach,
                           std::span<Wedge> wedges) const;
    void addSectors(std::span<const Wedge> wedges);

    glm::mat3 worldFromLocal_;
    std::array<Sector, 3 * most> sectors_;
    std::array<float, 3 * most> starts_;  ///< of the sectors, and then infinity
    std::size_t count_ = 0;
};

}  // namespace penumbra
