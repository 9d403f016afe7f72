#include "common/scene/clusters.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace penumbra {
namespace {

struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t size() const { return end - begin; }
};

int longestAxis(const std::vector<glm::vec3>& centres, std::span<const std::uint32_t> triangles) {
    glm::vec3 lower = centres[triangles[0]], upper = lower;
    for (const std::uint32_t t : triangles) {
        lower = glm::min(lower, centres[t]);
        upper = glm::max(upper, centres[t]);
    }
    const glm::vec3 size = upper - lower;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

/// Orders `triangles` into full clusters (the last may be smaller), each a box of a median split.
void splitByMedian(const std::vector<glm::vec3>& centres, std::vector<std::uint32_t>& triangles) {
    std::vector<Range> stack = {{0, std::uint32_t(triangles.size())}};
    while (!stack.empty()) {
        const Range range = stack.back();
        stack.pop_back();
        const auto first = triangles.begin() + range.begin, last = triangles.begin() + range.end;
        if (range.size() <= maxClusterTriangles) {
            std::sort(first, last);  // nth_element leaves the order inside open
            continue;
        }
        const std::uint32_t clusters = (range.size() + maxClusterTriangles - 1) / maxClusterTriangles;
        const std::uint32_t middle = range.begin + clusters / 2 * maxClusterTriangles;
        const int axis = longestAxis(centres, {&*first, range.size()});
        // Ties go by the triangle's number: a total order, so the halves do not depend on the library.
        std::nth_element(first, triangles.begin() + middle, last, [&](std::uint32_t a, std::uint32_t b) {
            const float x = centres[a][axis], y = centres[b][axis];
            return x < y || (x == y && a < b);
        });
        stack.push_back({middle, range.end});
        stack.push_back({range.begin, middle});
    }
}

/// meshoptimizer works on vertices 0 .. n-1, and wants memory for all of them: number those of the cluster
/// anew.
void orderForVertexCache(std::span<std::uint32_t> cluster) {
    std::vector<std::uint32_t> vertices(cluster.begin(), cluster.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<std::uint32_t> local(cluster.size());
    for (std::size_t i = 0; i < cluster.size(); ++i) {
        local[i] =
            std::uint32_t(std::lower_bound(vertices.begin(), vertices.end(), cluster[i]) - vertices.begin());
    }
    std::vector<std::uint32_t> ordered(local.size());
    meshopt_optimizeVertexCache(ordered.data(), local.data(), local.size(), vertices.size());
    for (std::size_t i = 0; i < cluster.size(); ++i) cluster[i] = vertices[ordered[i]];
}

}  // namespace

std::vector<std::uint32_t> clusterTriangles(std::span<const glm::vec3> positions,
                                            std::vector<std::uint32_t>& indices) {
    const std::uint32_t count = std::uint32_t(indices.size() / 3);
    std::vector<glm::vec3> centres(count);
    for (std::uint32_t t = 0; t < count; ++t) {
        // A third each before adding: the sum of three huge coordinates may overflow.
        centres[t] = positions[indices[3 * t]] / 3.0f + positions[indices[3 * t + 1]] / 3.0f +
                     positions[indices[3 * t + 2]] / 3.0f;
    }
    std::vector<std::uint32_t> triangles(count);
    std::iota(triangles.begin(), triangles.end(), 0u);
    splitByMedian(centres, triangles);

    std::vector<std::uint32_t> reordered;
    reordered.reserve(indices.size());
    for (const std::uint32_t t : triangles) {
        reordered.insert(reordered.end(), {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]});
    }
    indices = std::move(reordered);

    std::vector<std::uint32_t> sizes;
    for (std::uint32_t first = 0; first < count; first += maxClusterTriangles) {
        sizes.push_back(std::min(maxClusterTriangles, count - first));
        orderForVertexCache(
            std::span(indices).subspan(std::size_t(first) * 3, std::size_t(sizes.back()) * 3));
    }
    return sizes;
}

}  // namespace penumbra
