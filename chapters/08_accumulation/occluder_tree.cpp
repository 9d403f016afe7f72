#include "chapters/08_accumulation/occluder_tree.h"

#include <algorithm>
#include <bit>

namespace penumbra {

namespace {

constexpr std::size_t leafTriangles = 8;

}  // namespace

OccluderTree::OccluderTree(std::span<const Triangle> triangles) : triangles_(triangles) {
    leaves_ = std::bit_ceil(std::max<std::size_t>(1, (triangles.size() + leafTriangles - 1) / leafTriangles));
    boxes_.resize(2 * leaves_);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const glm::dvec3& p : triangles[i]) boxes_[leaves_ + i / leafTriangles].extend(p);
    for (std::size_t node = leaves_ - 1; node > 0; --node)
        for (const std::size_t child : {2 * node, 2 * node + 1}) boxes_[node].extend(boxes_[child]);
}

bool OccluderTree::reachesInto(const Reach& reach, std::size_t node) const {
    if (reach.misses(boxes_[node])) return false;
    if (node < leaves_) return reachesInto(reach, 2 * node) || reachesInto(reach, 2 * node + 1);
    const std::size_t first = (node - leaves_) * leafTriangles;
    const auto run = triangles_.subspan(first, std::min(leafTriangles, triangles_.size() - first));
    return std::any_of(run.begin(), run.end(), [&](const Triangle& t) { return !reach.misses(t); });
}

}  // namespace penumbra
