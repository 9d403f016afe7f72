#include "chapters/09_ambient_occlusion/vertex_bake.h"

#include <string>

#include "chapters/09_ambient_occlusion/least_squares.h"
#include "chapters/09_ambient_occlusion/vertex_bake_neighbours.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"
#include "chapters/09_ambient_occlusion/vertex_bake_run.h"
#include "common/error.h"
#include "common/math/sampling.h"
#include "common/truth/surface_hit.h"

namespace penumbra {

namespace {

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
