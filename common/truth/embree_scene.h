// All that touches Embree (3 or 4): building its hierarchy, and what its float answers are asked and told.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "common/truth/embree_hierarchy.h"
#include "common/truth/ray_tracer.h"
#include "common/truth/shadow_packet.h"

namespace penumbra {

/// Triangles [begin, end) are not there.
struct IgnoredTriangles {
    std::uint32_t begin = 0, end = 0;
    bool contains(std::uint32_t triangle) const { return triangle >= begin && triangle < end; }
};

/// Bit i for ray i of a packet.
struct PacketAnswer {
    std::uint32_t blocked = 0;
    /// Of those not blocked: Embree found a candidate, but in double the ray passes it, by a hair. Then its
    /// neighbour may be the one that is hit, and float may have missed that.
    std::uint32_t doubtful = 0;
};

/// Embree's copy of the triangles. Its answers to shadow rays are only candidates: each is taken if float can
/// be sure of it (surelyBlocks), and decided again in double (segment_test.h) if not. All queries may run on
/// many threads.
class EmbreeScene {
 public:
    /// Throws Error if Embree does not start, or memory is short. Keeps a reference to `scene`.
    explicit EmbreeScene(const Scene& scene);

    /// The triangle that Embree, in float, finds nearest.
    std::optional<std::uint32_t> nearest(const Ray& ray, const IgnoredTriangles& ignored) const;

    /// `rays`: 1 to 16, and `packet` made of them.
    PacketAnswer occluded(std::span<const ShadowRay> rays, const ShadowPacket& packet,
                          const IgnoredTriangles& ignored) const;

 private:
    const Scene& scene_;
    EmbreeHierarchy embree_;
    std::vector<float> heights_;  ///< decisiveHeight of each triangle
};

}  // namespace penumbra
