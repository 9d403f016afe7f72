// Surfaces that touch end in the same vertices. Where a vertex of one lies within an edge of the other (a
// T-junction), each rounds the line between them for itself, and here and there a pixel belongs to neither:
// one sees through the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/scene/gltf_loader.h"

namespace penumbra {
namespace {

using glm::dvec3;

constexpr double tolerance = 1e-5;  // metres: positions are rounded to a tenth of it

/// Vertices, each position once and in the order of x, and the edges between them.
struct Outline {
    std::vector<dvec3> vertices;
    std::set<std::pair<std::size_t, std::size_t>> edges;
};

bool isBefore(const dvec3& a, const dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Of triangles, three corners each.
Outline outlineOf(const std::vector<dvec3>& corners) {
    Outline outline{corners, {}};
    std::sort(outline.vertices.begin(), outline.vertices.end(), isBefore);
    outline.vertices.erase(std::unique(outline.vertices.begin(), outline.vertices.end()),
                           outline.vertices.end());
    const auto index = [&](std::size_t corner) {
        const auto at =
            std::lower_bound(outline.vertices.begin(), outline.vertices.end(), corners[corner], isBefore);
        return static_cast<std::size_t>(at - outline.vertices.begin());
    };
    for (std::size_t i = 0; i < corners.size(); ++i)
        outline.edges.insert(std::minmax(index(i), index(i % 3 == 2 ? i - 2 : i + 1)));
    return outline;
}

Outline outlineOf(const Scene& scene) {
    std::vector<dvec3> corners;
    for (const std::uint32_t i : scene.indices) corners.emplace_back(scene.positions[i]);
    return outlineOf(corners);
}

/// Vertices that lie within an edge, neither at its ends nor farther from it than `tolerance`.
std::vector<dvec3> verticesWithinEdges(const Outline& outline) {
    std::vector<dvec3> found;
    for (const auto& [from, to] : outline.edges) {
        const dvec3 &a = outline.vertices[from], &b = outline.vertices[to], along = b - a;
        const dvec3 upper = glm::max(a, b) + tolerance, lower = glm::min(a, b) - tolerance;
        const auto first =
            std::lower_bound(outline.vertices.begin(), outline.vertices.end(), lower, isBefore);
        for (auto v = first; v != outline.vertices.end() && v->x <= upper.x; ++v) {
            if (glm::clamp(*v, lower, upper) != *v || *v == a || *v == b) continue;
            const double part = glm::dot(*v - a, along) / glm::dot(along, along);
            if (part > 0.0 && part < 1.0 && glm::length(*v - a - part * along) < tolerance)
                found.push_back(*v);
        }
    }
    return found;
}

std::size_t seamsOf(const std::string& name) {
    const Scene scene = loadGltf(std::filesystem::path(PENUMBRA_SOURCE_DIR) / "assets" / (name + ".glb"));
    return verticesWithinEdges(outlineOf(scene)).size();
}

// Solids that are stuck into one another, or stand on one another, may touch where they like: what is below
// goes on under the seam. So a post's end lies on a rail's edge in fence and courtyard, and they are left
// out.
TEST(AssetsSeams, SurfacesThatTouchEndInTheSameVertices) {
    for (const char* scene : {"gully", "contact", "contact_panel", "spheres", "room", "heckbert_herf"})
        EXPECT_EQ(seamsOf(scene), 0u) << scene;
}

TEST(AssetsSeams, AVertexWithinAnEdgeIsFound) {
    const dvec3 a(0, 0, 0), b(3, 1, 0), c(1, 2, 0);
    for (const double part : {0.01, 0.5, 0.99}) {
        const dvec3 within = a + part * (b - a);
        EXPECT_EQ(verticesWithinEdges(outlineOf({a, b, c, within, {2, -3, 1}, {2, -3, 0}})).size(), 1u)
            << part;
        const dvec3 beside = within + dvec3(0, 0, 1e-4);
        EXPECT_EQ(verticesWithinEdges(outlineOf({a, b, c, beside, {2, -3, 1}, {2, -3, 0}})).size(), 0u)
            << part;
    }
    EXPECT_EQ(verticesWithinEdges(outlineOf({a, b, c, b, a, {1, -3, 0}})).size(), 0u)
        << "the same edge twice";
}

}  // namespace
}  // namespace penumbra
