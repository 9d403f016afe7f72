#include "chapters/09_ambient_occlusion/vertex_bake.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>

#include "chapters/09_ambient_occlusion/least_squares.h"
#include "chapters/09_ambient_occlusion/vertex_bake_neighbours.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/vertex_bake_run.h"
#include "chapters/09_ambient_occlusion/vertex_bake_shared.h"
#include "common/error.h"
#include "common/math/sampling.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

namespace {

/// All that the values of `points` depend on; `points` is what they are called. The number counts versions of
/// what the file holds.
ContentHash keyOf(const Scene& scene, const BakeSettings& settings, std::string_view points) {
    const AmbientRays& rays = settings.rays;
    ContentHash key;
    key.text("ambient values 1").text(points).geometry(scene).number(std::int64_t(rays.count));
    key.number(std::int64_t(rays.weighting)).number(rays.reach.range).number(std::int64_t(rays.reach.smooth));
    key.number(std::int64_t(settings.seed)).number(std::int64_t(settings.share));
    return key.number(std::int64_t(settings.skip));
}

template <class Neighbours>
AmbientBake bakePoints(const Scene& scene, const RayBundle& bundle, const BakePoints& points,
                       const BakeSettings& settings, std::string_view name, const Neighbours& neighbours,
                       const ProgressCallback& progress) {
    std::unique_ptr<Bake> bake;
    if (settings.share)
        bake = std::make_unique<SharedBake>(scene, bundle, points, settings, neighbours(scene, points));
    else
        bake = std::make_unique<LoneBake>(scene, bundle, points, settings);
    doAllPieces(*bake, settings.partialFile, keyOf(scene, settings, name), progress);
    AmbientBake result;
    result.work = bake->work();
    result.values.reserve(points.pointOf.size());
    const std::vector<AmbientValue> values = bake->values();
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
    LoneBake bake(scene, bundle, places, settings);
    doAllPieces(bake, settings.partialFile,
                keyOf(scene, settings, fmt::format("{} in each triangle", samplesPerTriangle)), progress);
    std::vector<double> values;
    for (const AmbientValue& v : bake.values())
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
    return bakePoints(scene, bundle, vertexPoints(scene), settings, "vertices", vertexNeighbours, progress);
}

AmbientBake bakeTriangles(const Scene& scene, const RayBundle& bundle, const BakeSettings& settings,
                          const ProgressCallback& progress) {
    return bakePoints(scene, bundle, trianglePoints(scene), settings, "triangles", triangleNeighbours,
                      progress);
}

}  // namespace penumbra
