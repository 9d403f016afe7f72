// Stored visibility from rays.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "chapters/09_ambient_occlusion/vertex_bake_horizon.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/visibility_bits.h"
#include "chapters/09_ambient_occlusion/work_in_pieces.h"
#include "common/error.h"
#include "common/truth/shadow_packet.h"

namespace penumbra {

namespace {

/// The directions in an order that keeps similar ones together: rays of one point go eight side by side.
std::vector<std::uint32_t> similarOrder(std::span<const glm::vec3> directions) {
    Aabb cube;
    cube.extend(glm::dvec3(-1.0));
    cube.extend(glm::dvec3(1.0));
    std::vector<std::uint32_t> order(directions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {},
                      [&](std::uint32_t l) { return mortonCode(glm::dvec3(directions[l]), cube); });
    return order;
}

class BitsBake final : public PieceWork {
 public:
    BitsBake(const Scene& scene, const RayBundle& bundle, int directions, double range, bool skip)
        : scene_(scene),
          bundle_(bundle),
          range_(range),
          skip_(skip),
          reach_(largestCoordinate(scene.bounds)),
          horizon_(scene),
          points_(vertexPoints(scene)),
          bits_(VisibilityBits::allBlocked(skyDirections(directions), points_.points.size())),
          order_(similarOrder(bits_.directions)) {}

    std::size_t pieces() const override { return piecesOf(points_.points.size()); }
    void doPiece(std::size_t which) override;
    std::vector<std::span<std::byte>> found(std::size_t done) override {
        return {memoryOf(bits_.words, pointsDone(points_.points.size(), done) * bits_.wordsPerPoint())};
    }
    BakedBits result() const;

 private:
    void bakePoint(std::size_t point, std::vector<BundleRay>& rays, std::vector<std::uint32_t>& asked);

    const Scene& scene_;
    const RayBundle& bundle_;
    double range_;
    bool skip_;  ///< raysToOpenSky
    double reach_;
    Horizon horizon_;
    BakePoints points_;
    VisibilityBits bits_;  ///< one for each of points_
    std::vector<std::uint32_t> order_;
    std::atomic<std::int64_t> rays_{0}, skipped_{0};
};

void BitsBake::bakePoint(std::size_t index, std::vector<BundleRay>& rays, std::vector<std::uint32_t>& asked) {
    const BakePoint& point = points_.points[index];
    const PointFan fan(scene_, points_, point, reach_);
    const glm::mat3 localFromWorld = glm::transpose(fan.worldFromLocal());
    rays.clear();
    asked.clear();
    for (const std::uint32_t l : order_) {
        const glm::vec3& direction = bits_.directions[l];
        if (!(glm::dot(point.normal, direction) > 0.0f)) continue;
        const glm::vec3* origin = fan.origin(localFromWorld * direction, direction);
        if (!origin) continue;
        rays.push_back({*origin, direction});
        asked.push_back(l);
    }
    std::vector<std::uint8_t> blocked(rays.size(), 0);
    if (!skip_ || horizon_.anythingAbove(points_, point, range_)) {
        bundle_.blocked(rays, float(range_), blocked);
        rays_ += std::int64_t(rays.size());
    } else {
        ++skipped_;
    }
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (!blocked[i]) bits_.setOpen(index, asked[i]);
}

void BitsBake::doPiece(std::size_t which) {
    forRuns(pieceOf(points_.points.size(), which), [&](PointRange run) {
        std::vector<BundleRay> rays;
        std::vector<std::uint32_t> asked;
        for (std::size_t i = run.first; i < run.end; ++i) bakePoint(i, rays, asked);
    });
}

BakedBits BitsBake::result() const {
    BakedBits baked{VisibilityBits::allBlocked(bits_.directions, points_.pointOf.size()), {}};
    const std::size_t words = bits_.wordsPerPoint();
    for (std::size_t i = 0; i < points_.pointOf.size(); ++i)
        std::copy_n(&bits_.words[points_.pointOf[i] * words], words, &baked.bits.words[i * words]);
    baked.work.points = std::int64_t(points_.pointOf.size());
    baked.work.merged = baked.work.points - std::int64_t(points_.points.size());
    baked.work.skipped = skipped_;
    baked.work.rays = rays_;
    baked.work.bytes = std::int64_t(points_.bytes() + horizon_.bytes() + bits_.bytes() + baked.bits.bytes());
    return baked;
}

ContentHash keyOf(const Scene& scene, int directions, double range) {
    return ContentHash()
        .text("visibility bits 2")
        .geometry(scene)
        .number(std::int64_t(directions))
        .number(range);
}

}  // namespace

BakedBits bakeBits(const Scene& scene, const RayBundle& bundle, int directions, const AmbientReach& reach,
                   const std::filesystem::path& partialFile, const ProgressCallback& progress, bool skip) {
    if (directions < 64 || directions > 1024)
        throw Error("visibility bits need 64 to 1024 directions, not " + std::to_string(directions));
    BitsBake bake(scene, bundle, directions, reach.range, skip);
    doAllPieces(bake, partialFile, keyOf(scene, directions, reach.range), progress);
    return bake.result();
}

}  // namespace penumbra
