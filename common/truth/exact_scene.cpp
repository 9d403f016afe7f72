#include "common/truth/exact_scene.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/truth/cone_subtraction.h"

namespace penumbra {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr std::size_t noLimit = std::numeric_limits<std::size_t>::max();

/// The open segment between two points, prepared for boxes and triangles.
class ShadowSegment {
 public:
    ShadowSegment(const glm::dvec3& start, const glm::dvec3& end)
        : start_(start), along_(end - start), inverse_(1.0 / along_) {
        const glm::dvec3 size = glm::abs(along_);
        main_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        shear_ = glm::dvec2(along_[second()], along_[third()]) * inverse_[main_];
    }

    /// Slab test (Kay & Kajiya, SIGGRAPH 1986), widened by its rounding error so that no box with a hit is
    /// missed (Ize, "Robust BVH Ray Traversal", JCGT 2013).
    bool misses(const Aabb& box) const {
        double enter = 0.0;
        double leave = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            if (along_[axis] == 0.0) {  // 0 times infinity would be no number at all
                if (start_[axis] < box.lower[axis] || start_[axis] > box.upper[axis]) return true;
                continue;
            }
            const double a = (box.lower[axis] - start_[axis]) * inverse_[axis];
            const double b = (box.upper[axis] - start_[axis]) * inverse_[axis];
            enter = std::max(enter, std::min(a, b) * (1.0 - 8.0 * epsilon));
            leave = std::min(leave, std::max(a, b) * (1.0 + 8.0 * epsilon));
        }
        return enter > leave;
    }

    /// Written apart from segment_test.h on purpose, since it checks what that decides. Seen along the
    /// segment every vertex is one point of the plane, and the sign of a difference of two rounded products
    /// is right or 0: so a segment through a shared edge or vertex hits at least one triangle (Woop, Benthin
    /// & Wald, "Watertight Ray/Triangle Intersection", JCGT 2013). Edge by edge in three dimensions it could
    /// slip through at a vertex.
    bool crosses(const Triangle& triangle) const {
        const glm::dvec3 a = triangle[0] - start_;
        const glm::dvec3 b = triangle[1] - start_;
        const glm::dvec3 c = triangle[2] - start_;
        const glm::dvec2 p = seenAlong(a), q = seenAlong(b), r = seenAlong(c);
        const double u = q.x * r.y - q.y * r.x;
        const double v = r.x * p.y - r.y * p.x;
        const double w = p.x * q.y - p.y * q.x;
        if (std::min({u, v, w}) < 0.0 && std::max({u, v, w}) > 0.0) return false;
        // From the corners themselves: as long as they are floats, one without area has none here either.
        const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        const double start = glm::dot(normal, a);  // distance of the start from the plane, times |normal|
        const double rounding = 8.0 * epsilon * (sumOfMagnitudes(start_) + sumOfMagnitudes(a));
        if (std::abs(start) <= rounding * glm::length(normal)) return false;
        const double end = glm::dot(normal, a - along_);
        return (start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0);
    }

 private:
    int second() const { return (main_ + 1) % 3; }
    int third() const { return (main_ + 2) % 3; }
    glm::dvec2 seenAlong(const glm::dvec3& v) const {
        return {v[second()] - shear_.x * v[main_], v[third()] - shear_.y * v[main_]};
    }

    glm::dvec3 start_;
    glm::dvec3 along_;
    glm::dvec3 inverse_;
    glm::dvec2 shear_;
    int main_ = 0;  ///< the axis it runs along most
};

/// The triangles that reach into the pyramid, in scene order, so that the result does not depend on the
/// hierarchy; one more than `atMost` if there are more.
std::span<const Triangle> gather(const TriangleBvh& bvh, const LightPyramid& pyramid, int ignorePart,
                                 std::uint32_t excludedTriangle, std::size_t atMost) {
    thread_local std::vector<const TriangleBvh::Entry*> found;
    thread_local std::vector<Triangle> occluders;
    found.clear();
    occluders.clear();
    bvh.traverse([&](const Aabb& box) { return outside(pyramid, box); },
                 [&](const TriangleBvh::Entry& entry) {
                     if (entry.part != ignorePart && entry.triangle != excludedTriangle)
                         found.push_back(&entry);
                     return found.size() > atMost;
                 });
    std::sort(found.begin(), found.end(),
              [](const auto* a, const auto* b) { return a->triangle < b->triangle; });
    for (const TriangleBvh::Entry* entry : found) occluders.push_back(entry->corners);
    return occluders;
}

}  // namespace

ExactScene::ExactScene(const Scene& scene) : bvh_(scene) {}

bool ExactScene::occluded(const glm::dvec3& x, std::uint32_t excludedTriangle, const glm::dvec3& target,
                          int ignorePart) const {
    const ShadowSegment segment(x, target);
    return bvh_.traverse([&](const Aabb& box) { return segment.misses(box); },
                         [&](const TriangleBvh::Entry& entry) {
                             return entry.part != ignorePart && entry.triangle != excludedTriangle &&
                                    segment.crosses(entry.corners);
                         });
}

double ExactScene::visibleFormFactor(const glm::dvec3& x, const glm::dvec3& n,
                                     std::span<const glm::dvec3> polygon, int ignorePart,
                                     std::uint32_t excludedTriangle) const {
    return sumOverPyramids(x, n, polygon, [&](const LightPyramid& pyramid) {
        return penumbra::visibleFormFactor(pyramid,
                                           gather(bvh_, pyramid, ignorePart, excludedTriangle, noLimit));
    });
}

std::optional<double> ExactScene::visibleFormFactorOfFew(const glm::dvec3& x, const glm::dvec3& n,
                                                         std::span<const glm::dvec3> polygon,
                                                         std::size_t atMost, int ignorePart,
                                                         std::uint32_t excludedTriangle) const {
    bool tooMany = false;
    const double sum = sumOverPyramids(x, n, polygon, [&](const LightPyramid& pyramid) {
        const auto occluders = gather(bvh_, pyramid, ignorePart, excludedTriangle, atMost);
        tooMany = tooMany || occluders.size() > atMost;
        return tooMany ? 0.0 : penumbra::visibleFormFactor(pyramid, occluders);
    });
    return tooMany ? std::nullopt : std::optional(sum);
}

std::vector<double> ExactScene::formFactorImage(const PlanarReceiver& receiver, const glm::ivec2& size,
                                                std::span<const glm::dvec3> polygon, int ignorePart) const {
    std::vector<double> image(std::size_t(size.x) * std::size_t(size.y));
    const glm::dvec3 n = receiver.normal();
    tbb::parallel_for(tbb::blocked_range2d<int>(0, size.y, 8, 0, size.x, 64), [&](const auto& range) {
        for (int row = range.rows().begin(); row < range.rows().end(); ++row)
            for (int column = range.cols().begin(); column < range.cols().end(); ++column)
                image[std::size_t(row) * std::size_t(size.x) + std::size_t(column)] =
                    visibleFormFactor(receiver.cellCentre(column, row, size), n, polygon, ignorePart);
    });
    return image;
}

}  // namespace penumbra
