#include "chapters/09_ambient_occlusion/vertex_bake_run.h"

#include <algorithm>

#include "chapters/09_ambient_occlusion/vertex_bake_horizon.h"
#include "common/math/sampling.h"
#include "common/truth/shadow_packet.h"

namespace penumbra {

Bake::Bake(const Scene& scene, const RayBundle& bundle, const BakePoints& points,
           const BakeSettings& settings)
    : scene_(scene),
      bundle_(bundle),
      points_(points),
      settings_(settings),
      reach_(largestCoordinate(scene.bounds)),
      open_(points.points.size(), 0) {
    findOpen();
}

void Bake::findOpen() {
    const Horizon horizon(scene_);
    forPoints(allOf(count()), [&](std::size_t i, std::int64_t&) {
        const BakePoint& point = points_.points[i];
        const bool noPlane = point.normal == glm::vec3(0.0f);  // a triangle without extent
        open_[i] = noPlane || !horizon.anythingAbove(points_, point, settings_.rays.reach.range);
    });
}

bool Bake::seesAll(std::size_t i, int rays, std::int64_t& traced) {
    if (!open_[i] || settings_.skip || points_.points[i].normal == glm::vec3(0.0f)) return open_[i] != 0;
    open_[i] = trace(i, rays, 0, traced).visibility == rays;
    return open_[i] != 0;
}

AmbientValue Bake::wholeSkyOf(std::size_t i) const {
    return wholeSky(glm::dvec3(points_.points[i].normal), settings_.rays.weighting);
}

RaySums Bake::trace(std::size_t i, int rays, std::uint32_t round, std::int64_t& traced,
                    LatticePart part) const {
    const PointFan fan(scene_, points_, points_.points[i], reach_);
    AmbientRays asked = settings_.rays;
    asked.count = rays;
    const std::uint32_t seed = hashSeed(std::uint32_t(i), settings_.seed, round);
    return tracePoint(bundle_, fan, asked, seed, traced, part);
}

BakeWork Bake::work() const {
    BakeWork work;
    work.points = std::int64_t(points_.pointOf.size());
    work.merged = work.points - std::int64_t(points_.points.size());
    work.skipped = settings_.skip ? std::count(open_.begin(), open_.end(), std::uint8_t(1)) : 0;
    work.rays = rays_;
    work.bytes = std::int64_t(bytes() + points_.bytes() + open_.size());
    return work;
}

void LoneBake::doPiece(std::size_t which) {
    forPoints(pieceOf(count(), which), [&](std::size_t i, std::int64_t& traced) {
        const int rays = settings().rays.count;
        values_[i] = seesAll(i, rays, traced) ? wholeSkyOf(i) : trace(i, rays, 0, traced).mean(rays);
    });
}

std::vector<std::span<std::byte>> LoneBake::found(std::size_t done) {
    const std::size_t points = pointsDone(count(), done);
    return {memoryOf(values_, points), open(points)};
}

}  // namespace penumbra
