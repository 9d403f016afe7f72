#include "chapters/09_ambient_occlusion/vertex_bake_shared.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace penumbra {

namespace {

OwnEstimate estimateOf(const AmbientValue& value, double halves) {
    return {glm::vec4(value.bent, value.visibility), float(halves)};
}

// Half of the rays that a point would need alone is about what pays most, and if it has to do without its
// neighbours, the second half makes of it what it would have had alone. With a quarter, the neighbours'
// differences cannot be told from noise, and so many points are refined in vain that it takes half as long
// again.
int raysOfFirstRound(int count) {
    return std::max(8, count / 4 * 2);
}

// Where a scene's vertices are so few or so far apart that neighbours see other things, asking them says so,
// and rounds that go on as if they could help cost a fifth more than none. (Of meshes it leaves a tenth to a
// third of the variance, of walls and boxes three quarters to all of it.)
constexpr double littleHelp = 0.5;

}  // namespace

SharedBake::SharedBake(const Scene& scene, const RayBundle& bundle, const BakePoints& points,
                       const BakeSettings& settings, PointNeighbours neighbours)
    : Bake(scene, bundle, points, settings),
      neighbours_(std::move(neighbours)),
      firstCount_(raysOfFirstRound(settings.rays.count)),
      own_(count()),
      others_(count()),
      variances_(count(), 1.0f),
      counts_(count(), firstCount_) {}

void SharedBake::doPiece(std::size_t which) {
    const std::size_t round = which / perRound(), piece = which % perRound();
    if (round == 0) return firstRays(piece);
    if (round == 1) {
        if (piece == 0) beginSecond();
        return secondRays(piece);
    }
    if (aim_.alone) return;
    if (piece == 0) beginLast();
    refine(piece);
}

std::vector<std::span<std::byte>> SharedBake::found(std::size_t done) {
    // The neighbours are asked within the first piece of the second round: before it there is nothing else.
    if (done <= perRound()) {
        const std::size_t points = pointsDone(count(), done);
        return {memoryOf(own_, points), open(points)};
    }
    return {memoryOf(own_, count()),    open(count()),
            memoryOf(others_, count()), memoryOf(variances_, count()),
            memoryOf(counts_, count()), std::as_writable_bytes(std::span(&aim_, 1))};
}

double SharedBake::timeShare(std::size_t done) const {
    constexpr std::array<double, 5> ends{0.0, 0.45, 0.6, 1.0, 1.0};
    const std::size_t round = done / perRound();
    const double within = double(done % perRound()) / double(perRound());
    return ends[round] + within * (ends[round + 1] - ends[round]);
}

/// The even half of a lattice of twice as many rays.
void SharedBake::firstRays(std::size_t piece) {
    forPoints(pieceOf(count(), piece), [&](std::size_t i, std::int64_t& traced) {
        if (seesAll(i, firstCount_, traced)) {
            own_[i] = estimateOf(wholeSkyOf(i), 0.0);
            return;
        }
        const RaySums sums = trace(i, firstCount_, 0, traced, LatticePart::even);
        const double difference = (2.0 * sums.everyOther - sums.visibility) / firstCount_;
        own_[i] = estimateOf(sums.mean(firstCount_), difference * difference);
    });
}

void SharedBake::beginSecond() {
    askNeighbours(0.0f);
    // As good, in the mean of squares, as rays.count rays at every point. It has to aim for better: an edge
    // is narrow, and the neighbours' variance knows only of the mean; and the lattices of several rounds
    // together are not as even as one. With 0.8 a coarse ball on the ground has an RMSE a quarter too large.
    constexpr double margin = 0.6;
    const double fewer = margin * std::pow(double(firstCount_) / settings().rays.count, 1.5);
    double alone = 0.0, together = 0.0;  // variance
    for (std::size_t i = 0; i < count(); ++i) {
        if (seesAll(i)) {
            variances_[i] = 0.0f;
            continue;
        }
        alone += double(others_[i].noise);
        together += double(variances_[i]);
    }
    if (together > littleHelp * alone) {
        aim_.alone = 1;
        return;
    }
    const double wanted = fewer * alone / double(count());
    aim_ = {wanted, thresholdOfMean(variances_, wanted)};
}

/// The odd half, where the variance is above the threshold, and neighbours profit too; alone, everywhere.
void SharedBake::secondRays(std::size_t piece) {
    const float threshold = aim_.alone ? 0.0f : float(aim_.threshold);
    forPoints(pieceOf(count(), piece), [&](std::size_t i, std::int64_t& traced) {
        if (seesAll(i) || variances_[i] <= threshold) return;
        const AmbientValue odd = trace(i, firstCount_, 0, traced, LatticePart::odd).mean(firstCount_);
        const glm::vec4 difference = estimateOf(odd, 0.0).value - own_[i].value;
        own_[i] = {own_[i].value + 0.5f * difference, 0.25f * difference.w * difference.w};
        counts_[i] = 2 * firstCount_;
    });
}

void SharedBake::beginLast() {
    const auto threshold = float(aim_.threshold);
    if (std::ranges::any_of(variances_, [&](float v) { return v > threshold; })) askNeighbours(threshold);
    aim_.threshold = thresholdOfMean(variances_, aim_.mean);
}

/// Replaces the variance of each point's visibility, if it is above `threshold`, by that with its neighbours'
/// help.
void SharedBake::askNeighbours(float threshold) {
    const SharedRays sharing(points(), neighbours_, own_);
    sharingBytes_ = sharing.bytes();
    forPoints(allOf(count()), [&](std::size_t i, std::int64_t&) {
        if (seesAll(i) || variances_[i] <= threshold) return;
        const NeighbourEstimate& other = others_[i] = sharing.at(std::uint32_t(i));
        glm::vec4 ignored(0.0f);
        variances_[i] = combine(ignored, other.noise, ignored, other.variance);
    });
}

/// More rays where the variance is above the threshold, as many as bring it down to it; and everywhere the
/// mean of what is known.
void SharedBake::refine(std::size_t piece) {
    const auto threshold = float(aim_.threshold);
    forPoints(pieceOf(count(), piece), [&](std::size_t i, std::int64_t& traced) {
        if (seesAll(i)) return;
        const float other = others_[i].variance, noise = others_[i].noise;
        glm::vec4& value = own_[i].value;
        float variance = noise;
        // Precisions add: threshold^-1 = noise^-1 + other^-1 + that of the new rays.
        const double missing = 1.0 / threshold - 1.0 / noise - 1.0 / other;
        if (missing > 0.0) {
            // The error of n rays goes as n^(-3/4).
            const double wanted = counts_[i] * std::pow(noise * missing, 2.0 / 3.0);
            const int rays = int(std::clamp(wanted, 8.0, 1.5 * settings().rays.count));
            const float added = noise * float(std::pow(double(counts_[i]) / rays, 1.5));
            variance =
                combine(value, variance, estimateOf(trace(i, rays, 1, traced).mean(rays), 0.0).value, added);
        }
        combine(value, variance, others_[i].value, other);
    });
}

AmbientValue SharedBake::result(std::size_t i) const {
    const glm::vec4& value = own_[i].value;
    if (value.w <= 0.0f) return {0.0, glm::dvec3(0.0)};
    return {std::min(1.0, double(value.w)), glm::dvec3(value)};
}

std::vector<AmbientValue> SharedBake::values() const {
    std::vector<AmbientValue> values(count());
    for (std::size_t i = 0; i < count(); ++i) values[i] = seesAll(i) ? wholeSkyOf(i) : result(i);
    return values;
}

std::size_t SharedBake::bytes() const {
    return count() * (sizeof(OwnEstimate) + sizeof(NeighbourEstimate) + sizeof(float) + sizeof(int)) +
           neighbours_.bytes() + sharingBytes_;
}

}  // namespace penumbra
