#include "common/truth/triangle_bvh.h"

#include <algorithm>

namespace penumbra {
namespace {

constexpr std::uint32_t leafSize = 4;

glm::dvec3 twiceCentre(const Triangle& t) {
    return glm::min(glm::min(t[0], t[1]), t[2]) + glm::max(glm::max(t[0], t[1]), t[2]);
}

int longestAxis(const glm::dvec3& size) {
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

}  // namespace

TriangleBvh::TriangleBvh(const Scene& scene) {
    entries_.reserve(scene.triangleCount());
    for (std::size_t part = 0; part < scene.parts.size(); ++part) {
        const std::uint32_t first = scene.parts[part].firstTriangle;
        for (std::uint32_t t = first; t < first + scene.parts[part].triangleCount; ++t) {
            Entry entry;
            for (std::size_t i = 0; i < 3; ++i)
                entry.corners[i] = glm::dvec3(scene.positions[scene.indices[3 * std::size_t(t) + i]]);
            entry.triangle = t;
            entry.part = int(part);
            entries_.push_back(entry);
        }
    }
    if (!entries_.empty()) build(0, std::uint32_t(entries_.size()));
}

/// Median split along the longest axis of the centres: never worse than log2(n) deep, whatever the scene.
void TriangleBvh::build(std::uint32_t first, std::uint32_t count) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    Aabb bounds, centres;
    for (std::uint32_t i = first; i < first + count; ++i) {
        for (const glm::dvec3& corner : entries_[i].corners) bounds.extend(corner);
        centres.extend(twiceCentre(entries_[i].corners));
    }
    nodes_[self].bounds = bounds;
    if (count <= leafSize) {
        nodes_[self].firstEntry = first;
        nodes_[self].entryCount = count;
    } else {
        const int axis = longestAxis(centres.size());
        const std::uint32_t half = count / 2;
        const auto begin = entries_.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [axis](const Entry& a, const Entry& b) {
            return twiceCentre(a.corners)[axis] < twiceCentre(b.corners)[axis];
        });
        build(first, half);
        build(first + half, count - half);
    }
    nodes_[self].skip = std::uint32_t(nodes_.size());
}

}  // namespace penumbra
