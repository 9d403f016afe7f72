// Stored visibility from rays, in pieces that survive an interruption.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numeric>

#include "chapters/09_ambient_occlusion/bake_file.h"
#include "chapters/09_ambient_occlusion/vertex_bake_horizon.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/visibility_bits.h"
#include "common/error.h"
#include "common/truth/shadow_packet.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

namespace {

/// Of this many points the bits are finished together: between two of them there is time to save.
constexpr std::size_t piece = 4096;
constexpr int pointsAtOnce = 64;
constexpr std::chrono::seconds betweenSaves(2);

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

class BitsBake {
 public:
    BitsBake(const Scene& scene, const RayBundle& bundle, int directions, double range)
        : scene_(scene),
          bundle_(bundle),
          range_(range),
          reach_(largestCoordinate(scene.bounds)),
          horizon_(scene),
          points_(vertexPoints(scene)),
          bits_(VisibilityBits::allBlocked(skyDirections(directions), points_.points.size())),
          order_(similarOrder(bits_.directions)) {}

    std::size_t pieces() const { return (points_.points.size() + piece - 1) / piece; }
    void bakePiece(std::size_t which);

    /// The bits of the first `done` pieces, as bytes.
    std::string_view finished(std::size_t done) const {
        const std::size_t words = std::min(done * piece, points_.points.size()) * bits_.wordsPerPoint();
        return {reinterpret_cast<const char*>(bits_.words.data()), words * sizeof(std::uint64_t)};
    }
    /// The number of pieces taken over.
    std::size_t takeUp(const PartialBake& partial) {
        if (partial.done > pieces() || partial.payload.size() != finished(partial.done).size()) return 0;
        std::memcpy(bits_.words.data(), partial.payload.data(), partial.payload.size());
        return partial.done;
    }
    BakedBits result() const;

 private:
    void bakePoint(std::size_t point, std::vector<BundleRay>& rays, std::vector<std::uint32_t>& asked);

    const Scene& scene_;
    const RayBundle& bundle_;
    double range_, reach_;
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
    if (horizon_.anythingAbove(points_, point, range_)) {
        bundle_.blocked(rays, float(range_), blocked);
        rays_ += std::int64_t(rays.size());
    } else {
        ++skipped_;
    }
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (!blocked[i]) bits_.setOpen(index, asked[i]);
}

void BitsBake::bakePiece(std::size_t which) {
    const std::size_t first = which * piece, count = std::min(piece, points_.points.size() - first);
    parallelRows(int((count + pointsAtOnce - 1) / pointsAtOnce), [&](int row) {
        std::vector<BundleRay> rays;
        std::vector<std::uint32_t> asked;
        const std::size_t begin = std::size_t(row) * pointsAtOnce;
        for (std::size_t i = begin; i < std::min(count, begin + pointsAtOnce); ++i)
            bakePoint(first + i, rays, asked);
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

/// A partial file, or none at all if its name is empty.
class Keeper {
 public:
    Keeper(std::filesystem::path file, std::string key) : file_(std::move(file)), key_(std::move(key)) {}

    std::optional<PartialBake> load() const {
        return file_.empty() ? std::nullopt : loadPartialBake(file_, key_);
    }
    void save(std::size_t done, std::string_view bytes) {
        if (file_.empty() || done == saved_) return;
        savePartialBake(file_, key_, done, bytes);
        saved_ = done;
        savedAt_ = Clock::now();
    }
    bool isTime() const { return Clock::now() - savedAt_ > betweenSaves; }
    void remove() const {
        std::error_code ignored;
        if (!file_.empty()) std::filesystem::remove(file_, ignored);
    }

 private:
    using Clock = std::chrono::steady_clock;
    std::filesystem::path file_;
    std::string key_;
    std::size_t saved_ = 0;
    Clock::time_point savedAt_ = Clock::now();
};

std::string keyOf(const Scene& scene, int directions, double range) {
    return ContentHash()
        .text("visibility bits 2")
        .geometry(scene)
        .number(std::int64_t(directions))
        .number(range)
        .hex();
}

}  // namespace

BakedBits bakeBits(const Scene& scene, const RayBundle& bundle, int directions, const AmbientReach& reach,
                   const std::filesystem::path& partialFile, const ProgressCallback& progress) {
    if (directions < 64 || directions > 1024)
        throw Error("visibility bits need 64 to 1024 directions, not " + std::to_string(directions));
    BitsBake bake(scene, bundle, directions, reach.range);
    Keeper keeper(partialFile, keyOf(scene, directions, reach.range));
    std::size_t done = 0;
    if (const auto partial = keeper.load()) done = bake.takeUp(*partial);
    try {
        while (done < bake.pieces()) {
            bake.bakePiece(done++);
            if (keeper.isTime()) keeper.save(done, bake.finished(done));
            if (progress) progress(double(done) / double(bake.pieces()));
        }
    } catch (...) {  // the caller's progress stops the work: nothing that is finished is lost
        keeper.save(done, bake.finished(done));
        throw;
    }
    keeper.remove();
    return bake.result();
}

}  // namespace penumbra
