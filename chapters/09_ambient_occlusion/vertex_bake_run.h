// A bake under way. Internal to vertex_bake.h.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "chapters/09_ambient_occlusion/vertex_bake.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/vertex_bake_rays.h"
#include "chapters/09_ambient_occlusion/work_in_pieces.h"

namespace penumbra {

/// The points, and which of them see the whole sky. Keeps references to all that it is given.
class Bake : public PieceWork {
 public:
    Bake(const Scene& scene, const RayBundle& bundle, const BakePoints& points, const BakeSettings& settings);

    /// Of each point, when all pieces are done.
    virtual std::vector<AmbientValue> values() const = 0;
    BakeWork work() const;

 protected:
    std::size_t count() const { return points_.points.size(); }
    const BakePoints& points() const { return points_; }
    const BakeSettings& settings() const { return settings_; }
    bool seesAll(std::size_t i) const { return open_[i] != 0; }
    /// Is it known that point `i` sees the whole sky? Without the skip that is not believed: all rays are
    /// traced, and one that is blocked makes it a point like any other.
    bool seesAll(std::size_t i, int rays, std::int64_t& traced);
    /// The memory of what the second `seesAll` found out about the first `points`.
    std::span<std::byte> open(std::size_t points) { return memoryOf(open_, points); }
    AmbientValue wholeSkyOf(std::size_t i) const;

    /// Rays of point `i`; each `round` has others.
    RaySums trace(std::size_t i, int rays, std::uint32_t round, std::int64_t& traced,
                  LatticePart part = LatticePart::whole) const;
    /// `body(i, traced)` for each of these points, on all cores.
    template <class Body>
    void forPoints(PointRange range, const Body& body) {
        forRuns(range, [&](PointRange run) {
            std::int64_t traced = 0;
            for (std::size_t i = run.first; i < run.end; ++i) body(i, traced);
            rays_ += traced;
        });
    }
    /// Memory besides the points, bytes.
    virtual std::size_t bytes() const = 0;

 private:
    void findOpen();

    const Scene& scene_;
    const RayBundle& bundle_;
    const BakePoints& points_;
    const BakeSettings& settings_;
    double reach_;
    std::vector<std::uint8_t> open_;  ///< 1: sees the whole sky, no ray needed
    std::atomic<std::int64_t> rays_{0};
};

/// settings.rays.count rays at every point.
class LoneBake final : public Bake {
 public:
    LoneBake(const Scene& scene, const RayBundle& bundle, const BakePoints& points,
             const BakeSettings& settings)
        : Bake(scene, bundle, points, settings), values_(count()) {}

    std::vector<AmbientValue> values() const override { return values_; }
    std::size_t pieces() const override { return piecesOf(count()); }
    void doPiece(std::size_t which) override;
    std::vector<std::span<std::byte>> found(std::size_t done) override;

 private:
    std::size_t bytes() const override { return values_.size() * sizeof(AmbientValue); }

    std::vector<AmbientValue> values_;
};

}  // namespace penumbra
