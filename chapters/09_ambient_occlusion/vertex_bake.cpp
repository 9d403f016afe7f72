#include "chapters/09_ambient_occlusion/vertex_bake.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "chapters/09_ambient_occlusion/least_squares.h"
#include "chapters/09_ambient_occlusion/shared_rays.h"
#include "chapters/09_ambient_occlusion/vertex_bake_horizon.h"
#include "chapters/09_ambient_occlusion/vertex_bake_neighbours.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/vertex_bake_rays.h"
#include "common/error.h"
#include "common/math/sampling.h"
#include "common/truth/shadow_packet.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

namespace {

constexpr int pointsAtOnce = 256;

/// A bake under way: the points, and what is known about them.
class Bake {
 public:
    Bake(const Scene& scene, const RayBundle& bundle, const BakePoints& points, const BakeSettings& settings,
         const ProgressCallback& progress)
        : scene_(scene),
          bundle_(bundle),
          points_(points),
          settings_(settings),
          progress_(progress),
          reach_(largestCoordinate(scene.bounds)),
          open_(points.points.size(), 0) {
        findOpen();
    }

    std::vector<AmbientValue> alone();
    std::vector<AmbientValue> shared(const PointNeighbours& neighbours);
    BakeWork work() const;

 private:
    void findOpen();
    /// Is it known that point `i` sees the whole sky? Without the skip that is not believed: all rays are
    /// traced, and one that is blocked makes it a point like any other.
    bool seesAll(std::size_t i, int count, std::int64_t& traced);
    void firstRays();
    std::vector<float> askNeighbours(const SharedRays& sharing);
    void refine(float threshold);
    AmbientValue result(std::size_t i) const;

    /// `body(i, traced)` for each point, on all cores; the progress goes from `from` to `to`.
    template <class Body>
    void forEachPoint(double from, double to, const Body& body);
    std::uint32_t seedOf(std::size_t i, std::uint32_t round) const {
        return hashSeed(std::uint32_t(i), settings_.seed, round);
    }
    RaySums trace(std::size_t i, int count, std::uint32_t round, std::int64_t& traced) const {
        const PointFan fan(scene_, points_, points_.points[i], reach_);
        AmbientRays rays = settings_.rays;
        rays.count = count;
        return tracePoint(bundle_, fan, rays, seedOf(i, round), traced);
    }

    const Scene& scene_;
    const RayBundle& bundle_;
    const BakePoints& points_;
    const BakeSettings& settings_;
    const ProgressCallback& progress_;
    double reach_;
    std::vector<std::uint8_t> open_;  ///< 1: sees the whole sky, no ray needed
    std::vector<OwnEstimate> own_;
    std::vector<NeighbourEstimate> others_;
    int firstCount_ = 0;
    std::atomic<std::int64_t> rays_{0};
    std::int64_t bytes_ = 0;
};

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

void Bake::findOpen() {
    const Horizon horizon(scene_);
    forEachPoint(0.0, 0.02, [&](std::size_t i, std::int64_t&) {
        const BakePoint& point = points_.points[i];
        const bool noPlane = point.normal == glm::vec3(0.0f);  // a triangle without extent
        open_[i] = noPlane || !horizon.anythingAbove(glm::dvec3(point.position), glm::dvec3(point.normal),
                                                     settings_.rays.reach.range);
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

OwnEstimate estimateOf(const AmbientValue& value, double halves) {
    return {glm::vec4(value.bent, value.visibility), float(halves)};
}

void Bake::firstRays() {
    // A third of the rays that a point would need alone is about what pays most: with fewer, the neighbours'
    // differences cannot be told from noise, and points are refined in vain.
    firstCount_ = std::max(8, settings_.rays.count / 6 * 2);
    own_.resize(points_.points.size());
    forEachPoint(0.02, 0.5, [&](std::size_t i, std::int64_t& traced) {
        if (seesAll(i, firstCount_, traced)) {
            own_[i] =
                estimateOf(wholeSky(glm::dvec3(points_.points[i].normal), settings_.rays.weighting), 0.0);
            return;
        }
        const RaySums sums = trace(i, firstCount_, 0, traced);
        const double difference = (2.0 * sums.everyOther - sums.visibility) / firstCount_;
        own_[i] = estimateOf(sums.mean(firstCount_), difference * difference);
    });
}

/// Variance of each point's visibility with its neighbours' help.
std::vector<float> Bake::askNeighbours(const SharedRays& sharing) {
    others_.resize(points_.points.size());
    std::vector<float> variances(points_.points.size(), 0.0f);
    forEachPoint(0.5, 0.6, [&](std::size_t i, std::int64_t&) {
        if (open_[i]) return;
        const NeighbourEstimate& other = others_[i] = sharing.at(std::uint32_t(i));
        glm::vec4 ignored(0.0f);
        variances[i] = combine(ignored, other.noise, ignored, other.variance);
    });
    return variances;
}

/// More rays where the variance is above `threshold`, as many as bring it down to it; and everywhere the mean
/// of what is known.
void Bake::refine(float threshold) {
    const auto variances = [&](std::size_t i) { return std::pair(others_[i].noise, others_[i].variance); };
    forEachPoint(0.6, 1.0, [&](std::size_t i, std::int64_t& traced) {
        if (open_[i]) return;
        const auto [noise, other] = variances(i);
        glm::vec4& value = own_[i].value;
        float variance = noise;
        // Precisions add: threshold^-1 = noise^-1 + other^-1 + that of the new rays.
        const double missing = 1.0 / threshold - 1.0 / noise - 1.0 / other;
        if (missing > 0.0) {
            // The error of n rays goes as n^(-3/4).
            const double wanted = firstCount_ * std::pow(noise * missing, 2.0 / 3.0);
            const int count = int(std::clamp(wanted, 8.0, 1.5 * settings_.rays.count));
            const float added = noise * float(std::pow(double(firstCount_) / count, 1.5));
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
    const SharedRays sharing(points_, neighbours, own_);
    std::vector<float> variances = askNeighbours(sharing);
    // As good, in the mean of squares, as rays.count rays at every point.
    const double fewer = std::pow(double(firstCount_) / settings_.rays.count, 1.5);
    double wanted = 0.0;
    for (std::size_t i = 0; i < variances.size(); ++i)
        if (!open_[i]) wanted += fewer * double(others_[i].noise);
    // A little better, because an edge is narrow, and the neighbours' variance knows only of the mean.
    constexpr double forEdges = 0.8;
    wanted *= forEdges / double(std::max<std::size_t>(1, variances.size()));
    bytes_ = std::int64_t(own_.size() * (sizeof(OwnEstimate) + sizeof(NeighbourEstimate) + sizeof(float)) +
                          neighbours.bytes() + sharing.bytes());
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

template <class Neighbours>
AmbientBake bakePoints(const Scene& scene, const RayBundle& bundle, const BakePoints& points,
                       const BakeSettings& settings, const Neighbours& neighbours,
                       const ProgressCallback& progress) {
    Bake bake(scene, bundle, points, settings, progress);
    const std::vector<AmbientValue> values =
        settings.share ? bake.shared(neighbours(scene, points)) : bake.alone();
    AmbientBake result;
    result.work = bake.work();
    result.values.reserve(points.pointOf.size());
    for (const std::uint32_t point : points.pointOf) result.values.push_back(values[point]);
    return result;
}

/// The equations for the points that vertices were merged into, so that a seam of texture charts does not
/// open.
struct SampledSurface {
    std::vector<std::uint32_t> indices;
    std::vector<SurfaceSample> samples;
};

SampledSurface sampledSurface(const Scene& scene, const BakePoints& vertices, int perTriangle,
                              std::uint32_t seed) {
    SampledSurface surface;
    for (const std::uint32_t vertex : scene.indices) surface.indices.push_back(vertices.pointOf[vertex]);
    for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
        const auto [a, b, c] = cornersOf(scene, t);
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a)) / perTriangle;
        for (int k = 0; k < perTriangle; ++k)
            surface.samples.push_back({t, stratifiedBarycentric(k, hashSeed(t, seed)), area});
    }
    return surface;
}

}  // namespace

AmbientBake bakeVerticesLeastSquares(const Scene& scene, const RayBundle& bundle,
                                     const BakeSettings& settings, int samplesPerTriangle,
                                     const ProgressCallback& progress) {
    if (samplesPerTriangle < 3)
        throw Error("least-squares vertex values need at least 3 samples in each triangle, not " +
                    std::to_string(samplesPerTriangle));
    const BakePoints places = spreadPoints(scene, samplesPerTriangle, settings.seed);
    Bake bake(scene, bundle, places, settings, progress);
    std::vector<double> values;
    for (const AmbientValue& v : bake.alone())
        values.insert(values.end(), {v.visibility, v.bent.x, v.bent.y, v.bent.z});
    const BakePoints vertices = vertexPoints(scene);
    const SampledSurface surface = sampledSurface(scene, vertices, samplesPerTriangle, settings.seed);
    const std::vector<double> x =
        leastSquaresVertices(surface.indices, vertices.points.size(), surface.samples, values, 4);
    AmbientBake result;
    result.work = bake.work();
    result.work.points = std::int64_t(scene.positions.size());
    result.work.merged = result.work.points - std::int64_t(vertices.points.size());
    for (const std::size_t point : vertices.pointOf)
        result.values.push_back({x[4 * point], {x[4 * point + 1], x[4 * point + 2], x[4 * point + 3]}});
    return result;
}

AmbientBake bakeVertices(const Scene& scene, const RayBundle& bundle, const BakeSettings& settings,
                         const ProgressCallback& progress) {
    return bakePoints(scene, bundle, vertexPoints(scene), settings, vertexNeighbours, progress);
}

AmbientBake bakeTriangles(const Scene& scene, const RayBundle& bundle, const BakeSettings& settings,
                          const ProgressCallback& progress) {
    return bakePoints(scene, bundle, trianglePoints(scene), settings, triangleNeighbours, progress);
}

}  // namespace penumbra
