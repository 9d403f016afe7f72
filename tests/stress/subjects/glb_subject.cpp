// A scene with extreme numbers, written as .glb and loaded again.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/error.h"
#include "common/scene/glb_writer.h"
#include "common/scene/gltf_loader.h"
#include "tests/stress/case.h"
#include "tests/stress/triangle_shapes.h"
#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {
namespace {

/// Metres, from the corners of `t` to those of the triangle of the scene that is most like it.
double nearest(const Triangle& t, const Scene& loaded) {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& other : trianglesIn(loaded))
        for (std::size_t first = 0; first < 3; ++first) {
            double farthest = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                farthest = std::max(farthest, glm::distance(loaded.origin + other[(first + i) % 3], t[i]));
            least = std::min(least, farthest);
        }
    return least;
}

/// Those whose area rounding cannot take away.
std::vector<Triangle> solid(const Scene& scene, double ulp) {
    std::vector<Triangle> triangles = trianglesIn(scene);
    std::erase_if(triangles, [&](const Triangle& t) {
        const double longest =
            std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
        return !(glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) > 8.0 * ulp * longest);
    });
    return triangles;
}

Verdict check(const Case& given) {
    Verdict verdict;
    Dice dice(std::uint64_t(given.integer("variant")));
    std::vector<Triangle> triangles;
    const glm::dvec3 where = given.number("distance") / std::sqrt(3.0) * glm::dvec3(1.0);
    for (Triangle t : trianglesOf(given.choice("shape"), {}, dice)) {
        for (glm::dvec3& p : t) p = given.number("scale") * p + where;
        triangles.push_back(t);
    }
    Scene scene = sceneOf(triangles);
    scene.cameras[0].position = scene.bounds.upper;  // near which digits are kept (Scene::origin)
    const double ulp =
        0x1p-23 * glm::length(glm::max(glm::abs(scene.bounds.lower), glm::abs(scene.bounds.upper)));
    const std::vector<Triangle> kept = solid(scene, ulp);
    const std::vector<glm::vec4> ambient(scene.positions.size(), glm::vec4(0.1f, 0.2f, 0.3f, 0.5f));
    const std::string bytes = glbOf(scene, ambient);
    std::optional<Scene> loaded;
    try {
        loaded = loadGltfFromMemory({bytes.begin(), bytes.end()}, "written", {});
    } catch (const Error& problem) {
        if (!kept.empty()) throw;
        verdict.refusal = problem.what();
        return verdict;
    }
    // What the loader subtracts it subtracts in double, and rounds what is left to float: a length of up to
    // two of the farthest, once along each axis. In whatever order.
    double moved = 0.0;
    for (const Triangle& t : kept) moved = std::max(moved, nearest(t, *loaded));
    verdict.expectAtMost("corners moved, float ulps of the farthest", moved / ulp, std::sqrt(3.0));
    return verdict;
}

const AddSubject glb({.name = "glb",
                      .claim = "a scene that is written and loaded again has its corners where they were",
                      .axes = {"shape", "scale", "distance", "variant"},
                      .check = check,
                      .share = 0.3});

}  // namespace
}  // namespace penumbra::stress
