#include "chapters/09_ambient_occlusion/vertex_bake_neighbours.h"

#include <algorithm>

namespace penumbra {

namespace {

/// `collect(point, found)` appends the neighbours of a point, with repetitions.
template <class Collect>
PointNeighbours neighbourLists(std::size_t points, const Collect& collect) {
    PointNeighbours result;
    result.first.reserve(points + 1);
    result.first.push_back(0);
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < points; ++i) {
        found.clear();
        collect(i, found);
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        std::erase(found, std::uint32_t(i));
        result.list.insert(result.list.end(), found.begin(), found.end());
        result.first.push_back(std::uint32_t(result.list.size()));
    }
    return result;
}

}  // namespace

PointNeighbours vertexNeighbours(const Scene& scene, const BakePoints& points) {
    return neighbourLists(points.points.size(), [&](std::size_t i, std::vector<std::uint32_t>& found) {
        for (const std::uint32_t t : points.trianglesOf(points.points[i]))
            for (std::size_t k = 0; k < 3; ++k) found.push_back(points.pointOf[scene.indices[3 * t + k]]);
    });
}

PointNeighbours triangleNeighbours(const Scene& scene, const BakePoints& points) {
    const BakePoints corners = vertexPoints(scene);
    return neighbourLists(points.points.size(), [&](std::size_t i, std::vector<std::uint32_t>& found) {
        const std::uint32_t triangle = points.trianglesOf(points.points[i])[0];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = corners.pointOf[scene.indices[3 * triangle + k]];
            for (const std::uint32_t t : corners.trianglesOf(corners.points[corner]))
                found.push_back(points.pointOf[t]);
        }
    });
}

}  // namespace penumbra
