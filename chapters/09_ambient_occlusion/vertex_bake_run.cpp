#include "chapters/09_ambient_occlusion/vertex_bake_run.h"

#include <algorithm>
#include <cmath>

#include "chapters/09_ambient_occlusion/vertex_bake_horizon.h"
#include "common/math/sampling.h"
#include "common/truth/shadow_packet.h"

namespace penumbra {

namespace {

constexpr int pointsAtOnce = 256;

OwnEstimate estimateOf(const AmbientValue& value, double halves) {
    return {glm::vec4(value.bent, value.visibility), float(halves)};
}

}  // namespace

Bake::Bake(const Scene& scene, const RayBundle& bundle, const BakePoints& points,
           const BakeSettings& settings, const ProgressCallback& progress)
    : scene_(scene),
      bundle_(bundle),
      points_(points),
      settings_(settings),
      progress_(progress),
      reach_(largestCoordinate(scene.bounds)),
      open_(points.points.size(), 0) {
    findOpen();
}

template <class Body>
void Bake::forEachPoint(double from, double to, const Body& body) {
    const int count = int(points_.points.size());
    const auto some = [&](int row) {
        std::int64_t traced = 0;
        for (int i = row * pointsAtOnce; i < std::min(count, (row + 1) * pointsAtOnce); ++i)
            body(std::size_t(i), traced);
        rays_ += traced;
    };
    const auto part = [&](double fraction) {
        if (progress_) progress_(from + (to - from) * fraction);
    };
    parallelRows((count + pointsAtOnce - 1) / pointsAtOnce, some, part);
}

RaySums Bake::trace(std::size_t i, int count, std::uint32_t round, std::int64_t& traced,
                    LatticePart part) const {
    const PointFan fan(scene_, points_, points_.points[i], reach_);
    AmbientRays rays = settings_.rays;
    rays.count = count;
    const std::uint32_t seed = hashSeed(std::uint32_t(i), settings_.seed, round);
    return tracePoint(bundle_, fan, rays, seed, traced, part);
}

void Bake::findOpen() {
    const Horizon horizon(scene_);
    forEachPoint(0.0, 0.02, [&](std::size_t i, std::int64_t&) {
        const BakePoint& point = points_.points[i];
        const bool noPlane = point.normal == glm::vec3(0.0f);  // a triangle without extent
        open_[i] = noPlane || !horizon.anythingAbove(points_, point, settings_.rays.reach.range);
    });
}

bool Bake::seesAll(std::size_t i, int count, std::int64_t& traced) {
    if (!open_[i] || settings_.skip || points_.points[i].normal == glm::vec3(0.0f)) return open_[i] != 0;
    open_[i] = trace(i, count, 0, traced).visibility == count;
    return open_[i] != 0;
}

std::vector<AmbientValue> Bake::alone() {
    std::vector<AmbientValue> values(points_.points.size());
    forEachPoint(0.02, 1.0, [&](std::size_t i, std::int64_t& traced) {
        const int count = settings_.rays.count;
        values[i] = seesAll(i, count, traced)
                        ? wholeSky(glm::dvec3(points_.points[i].normal), settings_.rays.weighting)
                        : trace(i, count, 0, traced).mean(count);
    });
    bytes_ = std::int64_t(values.size() * sizeof(AmbientValue));
    return values;
}

/// The even half of a lattice of twice as many rays.
void Bake::firstRays() {
    // Nearly half of the rays that a point would need alone is what pays most. With a quarter, the
    // neighbours' differences cannot be told from noise, and so many points are refined in vain that it takes
    // half as long again.
    firstCount_ = std::max(8, settings_.rays.count * 9 / 40 * 2);
    own_.resize(points_.points.size());
    counts_.assign(points_.points.size(), firstCount_);
    forEachPoint(0.02, 0.4, [&](std::size_t i, std::int64_t& traced) {
        if (seesAll(i, firstCount_, traced)) {
            own_[i] =
                estimateOf(wholeSky(glm::dvec3(points_.points[i].normal), settings_.rays.weighting), 0.0);
            return;
        }
        const RaySums sums = trace(i, firstCount_, 0, traced, LatticePart::even);
        const double difference = (2.0 * sums.everyOther - sums.visibility) / firstCount_;
        own_[i] = estimateOf(sums.mean(firstCount_), difference * difference);
    });
}

/// The odd half, where the variance is above the threshold: neighbours profit too.
void Bake::secondRays(std::span<const float> variances, float threshold) {
    forEachPoint(0.45, 0.6, [&](std::size_t i, std::int64_t& traced) {
        if (open_[i] || variances[i] <= threshold) return;
        const AmbientValue odd = trace(i, firstCount_, 0, traced, LatticePart::odd).mean(firstCount_);
        const glm::vec4 difference = estimateOf(odd, 0.0).value - own_[i].value;
        own_[i] = {own_[i].value + 0.5f * difference, 0.25f * difference.w * difference.w};
        counts_[i] = 2 * firstCount_;
    });
}

/// Replaces the variance of each point's visibility, if it is above `threshold`, by that with its neighbours'
/// help.
void Bake::askNeighbours(const SharedRays& sharing, float threshold, std::vector<float>& variances) {
    forEachPoint(0.4, 0.45, [&](std::size_t i, std::int64_t&) {
        if (open_[i] || variances[i] <= threshold) return;
        const NeighbourEstimate& other = others_[i] = sharing.at(std::uint32_t(i));
        glm::vec4 ignored(0.0f);
        variances[i] = combine(ignored, other.noise, ignored, other.variance);
    });
}

/// More rays where the variance is above `threshold`, as many as bring it down to it; and everywhere the mean
/// of what is known.
void Bake::refine(float threshold) {
    forEachPoint(0.6, 1.0, [&](std::size_t i, std::int64_t& traced) {
        if (open_[i]) return;
        const float other = others_[i].variance, noise = others_[i].noise;
        glm::vec4& value = own_[i].value;
        float variance = noise;
        // Precisions add: threshold^-1 = noise^-1 + other^-1 + that of the new rays.
        const double missing = 1.0 / threshold - 1.0 / noise - 1.0 / other;
        if (missing > 0.0) {
            // The error of n rays goes as n^(-3/4).
            const double wanted = counts_[i] * std::pow(noise * missing, 2.0 / 3.0);
            const int count = int(std::clamp(wanted, 8.0, 1.5 * settings_.rays.count));
            const float added = noise * float(std::pow(double(counts_[i]) / count, 1.5));
            variance = combine(value, variance, estimateOf(trace(i, count, 1, traced).mean(count), 0.0).value,
                               added);
        }
        combine(value, variance, others_[i].value, other);
    });
}

AmbientValue Bake::result(std::size_t i) const {
    const glm::vec4& value = own_[i].value;
    if (value.w <= 0.0f) return {0.0, glm::dvec3(0.0)};
    return {std::min(1.0, double(value.w)), glm::dvec3(value)};
}

std::vector<AmbientValue> Bake::shared(const PointNeighbours& neighbours) {
    firstRays();
    others_.resize(points_.points.size());
    std::vector<float> variances(points_.points.size(), 1.0f);
    double wanted = 0.0;
    SharedRays sharing(points_, neighbours, own_);
    askNeighbours(sharing, 0.0f, variances);
    bytes_ = std::int64_t(
        own_.size() * (sizeof(OwnEstimate) + sizeof(NeighbourEstimate) + sizeof(float) + sizeof(int)) +
        neighbours.bytes() + sharing.bytes());
    // As good, in the mean of squares, as rays.count rays at every point. It has to aim for better: an edge
    // is narrow, and the neighbours' variance knows only of the mean; and the lattices of several rounds
    // together are not as even as one. With 0.8 a coarse ball on the ground has an RMSE a quarter too large.
    constexpr double margin = 0.6;
    const double fewer = margin * std::pow(double(firstCount_) / settings_.rays.count, 1.5);
    for (std::size_t i = 0; i < variances.size(); ++i)
        if (!open_[i])
            wanted += fewer * double(others_[i].noise);
        else
            variances[i] = 0.0f;
    wanted /= double(std::max<std::size_t>(1, variances.size()));
    const float threshold = thresholdOfMean(variances, wanted);
    if (std::ranges::any_of(variances, [&](float v) { return v > threshold; })) {
        secondRays(variances, threshold);
        sharing.update();
        askNeighbours(sharing, threshold, variances);
    }
    refine(thresholdOfMean(std::move(variances), wanted));
    std::vector<AmbientValue> values(own_.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] =
            open_[i] ? wholeSky(glm::dvec3(points_.points[i].normal), settings_.rays.weighting) : result(i);
    return values;
}

BakeWork Bake::work() const {
    BakeWork work;
    work.points = std::int64_t(points_.pointOf.size());
    work.merged = work.points - std::int64_t(points_.points.size());
    work.skipped = settings_.skip ? std::count(open_.begin(), open_.end(), std::uint8_t(1)) : 0;
    work.rays = rays_;
    work.bytes = bytes_ + std::int64_t(points_.bytes() + open_.size());
    return work;
}

}  // namespace penumbra
