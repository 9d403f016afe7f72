#include "common/scene/closed.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>
#include <vector>

namespace penumbra {
namespace {

/// A number for each vertex, equal exactly where positions are equal (0 and -0 are).
std::vector<std::uint32_t> weldByPosition(std::span<const glm::vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        return std::tie(positions[i].x, positions[i].y, positions[i].z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
        welded[order[i]] = same ? welded[order[i - 1]] : order[i];
    }
    return welded;
}

struct DirectedEdge {
    std::uint32_t low = 0, high = 0;  ///< its two vertices
    bool upwards = false;             ///< runs from low to high
    std::uint32_t triangle = 0;
};

/// Union-find with path halving (Tarjan & van Leeuwen 1984); the sets are the connected shells.
std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

std::vector<DirectedEdge> sortedEdges(std::span<const std::uint32_t> indices,
                                      const std::vector<std::uint32_t>& welded) {
    std::vector<DirectedEdge> edges;
    edges.reserve(indices.size());
    for (std::uint32_t t = 0; t < indices.size() / 3; ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = welded[indices[3 * t + k]], b = welded[indices[3 * t + (k + 1) % 3]];
            edges.push_back({std::min(a, b), std::max(a, b), a < b, t});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        return std::tie(a.low, a.high, a.upwards) < std::tie(b.low, b.high, b.upwards);
    });
    return edges;
}

/// Joins the triangles across every edge; false if some edge is not shared by two of opposite direction.
bool joinAcrossEdges(const std::vector<DirectedEdge>& edges, std::vector<std::uint32_t>& parent) {
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        if (i + 1 == edges.size()) return false;
        const DirectedEdge &down = edges[i], &up = edges[i + 1];
        if (down.low != up.low || down.high != up.high || down.low == down.high) return false;
        // Of more than two triangles on one edge the first two, or the next two, run the same way.
        if (down.upwards || !up.upwards) return false;
        parent[rootOf(parent, down.triangle)] = rootOf(parent, up.triangle);
    }
    return true;
}

}  // namespace

bool isClosed(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    if (indices.empty()) return false;
    const std::vector<std::uint32_t> welded = weldByPosition(positions);
    std::vector<std::uint32_t> parent(indices.size() / 3);
    std::iota(parent.begin(), parent.end(), 0u);
    if (!joinAcrossEdges(sortedEdges(indices, welded), parent)) return false;

    std::vector<double> volume(parent.size(), 0.0);
    const glm::dvec3 reference = positions[indices[0]];
    for (std::uint32_t t = 0; t < parent.size(); ++t) {
        const glm::dvec3 a = glm::dvec3(positions[indices[3 * t]]) - reference;
        const glm::dvec3 b = glm::dvec3(positions[indices[3 * t + 1]]) - reference;
        const glm::dvec3 c = glm::dvec3(positions[indices[3 * t + 2]]) - reference;
        volume[rootOf(parent, t)] += glm::dot(a, glm::cross(b, c));
    }
    for (std::uint32_t t = 0; t < parent.size(); ++t) {
        if (parent[t] == t && !(volume[t] > 0.0)) return false;
    }
    return true;
}

}  // namespace penumbra
