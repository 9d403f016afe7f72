// What can come between a light and a receiver: so that nothing else is drawn, and texels that nothing can
// shadow are lit from the closed form.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "common/math/aabb.h"
#include "common/math/polygon.h"
#include "common/scene/culling.h"
#include "common/scene/scene.h"
#include "common/truth/cone_subtraction.h"

namespace penumbra {

/// The space between a light and a convex area of a receiver's plane: all segments from a point of one to a
/// point of the other. Conservative: what it says misses this space shadows no point of the area; what misses
/// it by less than a billionth of its size is kept.
class Reach {
 public:
    /// `area`: the area's corners in order, in the plane through them with unit normal `normal`.
    Reach(std::span<const glm::dvec3> area, const glm::dvec3& normal, const Light& light);
    /// Of the whole parallelogram of a receiver.
    Reach(const Receiver& receiver, const Light& light);

    /// No light arrives anywhere on the area: the light is wholly below its horizon, or shows it its back.
    bool empty() const { return pieces_.empty(); }
    /// True only if nothing in the box (of the triangle) reaches in. What lies in the receiver's plane,
    /// within the rounding of floats, or below it, misses.
    bool misses(const Aabb& box) const;
    bool misses(const Triangle& triangle) const;

 private:
    struct Plane {
        glm::dvec3 inward{0.0};  ///< unit
        glm::dvec3 point{0.0};
        double slack = 0.0;  ///< metres
    };
    /// What is outside all planes of one group misses: the planes through one edge of the light and each
    /// corner of the area. For a given edge and point p, the volume spanned by the edge, p and x is affine in
    /// x, so what is outside from all corners is outside from all points between them.
    struct Group {
        std::uint32_t first = 0, count = 0;  ///< of `planes_`
    };
    struct Piece {
        std::uint32_t first = 0, count = 0;  ///< of `groups_`
        Polygon3 area, light;                ///< cut to where they see each other; no light: a point's
    };

    void addPolygon(const Polygon3& area, const glm::dvec3& normal, const Polygon3& light);
    void addDirection(const Polygon3& area, const glm::dvec3& normal, const glm::dvec3& toLight,
                      bool isPoint);
    void add(const glm::dvec3& inward, const glm::dvec3& point, double slack);
    void close(std::uint32_t groupStart);
    template <class Outside>
    bool missesPlanes(const Piece& piece, const Outside& outside) const;
    /// Is the piece of the light beside the triangle, past one of its edges, from everywhere on the area?
    bool passesAnEdge(const Piece& piece, const Triangle& triangle, double slack) const;

    std::vector<Plane> planes_;
    std::vector<Group> groups_;
    std::vector<Piece> pieces_;  ///< one for each convex polygon of the light
    double scale_ = 0.0;         ///< metres: of the numbers that rounded
};

/// What may shadow a receiver.
struct Occluders {
    VisibleClusters clusters;        ///< all triangles that reach between are in these
    std::vector<Triangle> reaching;  ///< those triangles, in scene order
    double highest = 0.0;            ///< metres above the receiver's plane, of any corner of those triangles
    double near = 0.5;  ///< for projectOnReceiver: nothing of them is nearer to any point of the light
};

/// Leaves out the light's own part and everything that can't shadow the receiver.
Occluders occludersBetween(const Scene& scene, const Receiver& receiver, const Light& light);

}  // namespace penumbra
