// Ambient visibility and bent vectors, computed once and stored: one value per vertex, or one per triangle.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "common/app/skips.h"
#include "common/scene/scene.h"
#include "common/truth/parallel.h"
#include "common/truth/ray_bundle.h"

namespace penumbra {

inline constexpr Skip raysToOpenSky{"rays-to-open-sky", "rays_traced",
                                    "no ray from where nothing rises above the tangent plane (within "
                                    "--range): all of them would get away"};

struct BakeSettings {
    /// `count`: as accurate as so many rays at every point, each point on its own. 16: a preview; 256: RMSE
    /// 0.006; 4096: 0.001.
    AmbientRays rays{256, Weighting::cosine, {}};
    std::uint32_t seed = 1;
    /// Neighbours use one another's rays, where that is shown to cost no accuracy (shared_rays.h). false:
    /// exactly `count` rays at every point.
    bool share = true;
    bool skip = true;  ///< raysToOpenSky
    /// What is finished waits here if the bake is interrupted (doAllPieces in work_in_pieces.h). Empty: it
    /// does not.
    std::filesystem::path partialFile = {};
};

struct BakeWork {
    std::int64_t points = 0;   ///< vertices or triangles asked for
    std::int64_t merged = 0;   ///< of these, at the same place with the same normal as another: computed once
    std::int64_t skipped = 0;  ///< of the rest, with nothing above their tangent plane: no ray
    std::int64_t rays = 0;     ///< traced
    std::int64_t bytes = 0;    ///< largest memory of the bake itself, besides scene and hierarchy
};

struct AmbientBake {
    std::vector<AmbientValue> values;
    BakeWork work;
};

/// values[i] for vertex i of Scene::positions, about Scene::normals[i]. Vertices that coincide and have equal
/// normals get the same value. The same for any number of threads.
AmbientBake bakeVertices(const Scene& scene, const RayBundle& bundle, const BakeSettings& settings,
                         const ProgressCallback& progress = {});

/// values[t] at the centroid of triangle t, about its geometric normal (the loop "for each triangle" of the
/// lecture). Triangles without extent are 1.
AmbientBake bakeTriangles(const Scene& scene, const RayBundle& bundle, const BakeSettings& settings,
                          const ProgressCallback& progress = {});

/// values[i] for vertex i such that their linear interpolation is nearest to the ambient visibility (and bent
/// vector) all over the triangles, in the sense of least squares (least_squares.h): a vertex under a box no
/// longer darkens everything around it. Values may leave [0,1] by a little where that makes the whole nearer.
/// `settings.rays.count` rays at each of `samplesPerTriangle` (at least 3) points of every triangle.
AmbientBake bakeVerticesLeastSquares(const Scene& scene, const RayBundle& bundle,
                                     const BakeSettings& settings, int samplesPerTriangle = 4,
                                     const ProgressCallback& progress = {});

}  // namespace penumbra
