// A bake whose points help one another (shared_rays.h). Internal to vertex_bake.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/shared_rays.h"
#include "chapters/09_ambient_occlusion/vertex_bake_neighbours.h"
#include "chapters/09_ambient_occlusion/vertex_bake_run.h"

namespace penumbra {

/// Three rounds, each of all points in pieces. Within a round every point goes by what was known when the
/// round began, so the pieces of a round do not know of one another; between two rounds the neighbours are
/// asked. What is kept of an interrupted bake are whole pieces of a round.
class SharedBake final : public Bake {
 public:
    SharedBake(const Scene& scene, const RayBundle& bundle, const BakePoints& points,
               const BakeSettings& settings, PointNeighbours neighbours);

    std::vector<AmbientValue> values() const override;
    std::size_t pieces() const override { return 3 * perRound(); }
    void doPiece(std::size_t which) override;
    std::vector<std::span<std::byte>> found(std::size_t done) override;
    double timeShare(std::size_t done) const override;

 private:
    /// What the rounds aim at.
    struct Aim {
        double mean = 0.0;       ///< of the variances, in the end
        double threshold = 0.0;  ///< of this round: who is above needs more
        std::int64_t alone = 0;  ///< 1: neighbours help too little, and each point has all of its rays
    };

    std::size_t perRound() const { return piecesOf(count()); }
    void firstRays(std::size_t piece);
    void beginSecond();
    void secondRays(std::size_t piece);
    void beginLast();
    void refine(std::size_t piece);
    void askNeighbours(float threshold);
    AmbientValue result(std::size_t i) const;
    std::size_t bytes() const override;

    PointNeighbours neighbours_;
    int firstCount_;
    std::vector<OwnEstimate> own_;
    std::vector<NeighbourEstimate> others_;
    std::vector<float> variances_;  ///< of each point's visibility, with its neighbours' help
    std::vector<int> counts_;       ///< rays of each point so far
    Aim aim_;
    std::size_t sharingBytes_ = 0;
};

}  // namespace penumbra
