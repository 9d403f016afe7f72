// A bounding volume hierarchy over the triangles of a scene, in double precision, owing nothing to Embree:
// what checks the reference ray tracer must not share its bugs.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/math/aabb.h"
#include "common/scene/scene.h"
#include "common/truth/cone_subtraction.h"

namespace penumbra {

class TriangleBvh {
 public:
    struct Entry {
        Triangle corners;
        std::uint32_t triangle = 0;  ///< index into Scene::indices / 3
        int part = 0;
    };

    explicit TriangleBvh(const Scene& scene);

    /// Calls `visit(entry)` for every triangle in a box that `reject(box)` does not reject, in a fixed order,
    /// until it returns true; returns whether it did.
    template <class Reject, class Visit>
    bool traverse(const Reject& reject, const Visit& visit) const {
        std::uint32_t i = 0;
        while (i < nodes_.size()) {
            const Node& node = nodes_[i];
            if (reject(node.bounds)) {
                i = node.skip;
                continue;
            }
            for (std::uint32_t e = node.firstEntry; e < node.firstEntry + node.entryCount; ++e)
                if (visit(entries_[e])) return true;
            ++i;
        }
        return false;
    }

 private:
    /// Stored in depth-first order, so that a walk needs no stack: on to the next node, or past the whole
    /// subtree.
    struct Node {
        Aabb bounds;
        std::uint32_t skip = 0;  ///< the node after this subtree
        std::uint32_t firstEntry = 0;
        std::uint32_t entryCount = 0;  ///< 0 for inner nodes
    };
    void build(std::uint32_t first, std::uint32_t count);

    std::vector<Entry> entries_;
    std::vector<Node> nodes_;
};

}  // namespace penumbra
