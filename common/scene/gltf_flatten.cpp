#include "common/scene/gltf_flatten.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

#include "common/scene/closed.h"
#include "common/scene/clusters.h"

namespace penumbra::gltf {
namespace {

/// Unit vector, or zero if `v` has no direction. In double: squares of small floats underflow.
glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !std::isfinite(largest)) return glm::dvec3(0.0);
    return glm::normalize(v / largest);
}

glm::dvec3 flatNormal(const PartMesh& mesh, std::size_t triangle) {
    const glm::dvec3 a = mesh.positions[mesh.indices[3 * triangle]];
    const glm::dvec3 b = mesh.positions[mesh.indices[3 * triangle + 1]];
    const glm::dvec3 c = mesh.positions[mesh.indices[3 * triangle + 2]];
    return unitOrZero(glm::cross(b - a, c - a));
}

/// A triangle with two equal corners covers nothing, and would be an edge of no direction to everyone who
/// comes later.
void dropTrianglesWithoutExtent(PartMesh& mesh) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const std::uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
        const glm::vec3 &pa = mesh.positions[a], &pb = mesh.positions[b], &pc = mesh.positions[c];
        if (pa == pb || pb == pc || pc == pa) continue;
        mesh.indices[kept++] = a;
        mesh.indices[kept++] = b;
        mesh.indices[kept++] = c;
    }
    mesh.indices.resize(kept);
}

template <class Vector>
void unshare(std::vector<Vector>& values, const std::vector<std::uint32_t>& indices) {
    std::vector<Vector> own;
    own.reserve(indices.size());
    for (const std::uint32_t index : indices) own.push_back(values[index]);
    values = std::move(own);
}

const glm::vec3 anyAxis(0.0f, 1.0f, 0.0f);

void makeFlat(PartMesh& mesh) {
    unshare(mesh.positions, mesh.indices);
    unshare(mesh.uvs, mesh.indices);
    if (!mesh.ambient.empty()) unshare(mesh.ambient, mesh.indices);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = std::uint32_t(i);
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const glm::dvec3 n = flatNormal(mesh, t);
        std::fill_n(mesh.normals.begin() + std::ptrdiff_t(3 * t), 3,
                    n == glm::dvec3(0.0) ? anyAxis : glm::vec3(n));
    }
}

/// Makes every normal unit. One without a direction (zero, infinite, NaN) becomes the flat normal of the
/// first triangle that has one there.
std::size_t repairNormals(PartMesh& mesh) {
    std::vector<bool> missing(mesh.normals.size(), false);
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const glm::dvec3 n = unitOrZero(mesh.normals[i]);
        mesh.normals[i] = n == glm::dvec3(0.0) ? anyAxis : glm::vec3(n);
        missing[i] = n == glm::dvec3(0.0);
        count += missing[i] ? 1 : 0;
    }
    for (std::size_t t = 0; t < mesh.indices.size() / 3 && count > 0; ++t) {
        const glm::dvec3 n = flatNormal(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[3 * t + k];
            if (!missing[vertex] || n == glm::dvec3(0.0)) continue;
            mesh.normals[vertex] = glm::vec3(n);
            missing[vertex] = false;
        }
    }
    return count;
}

/// Vertices in the order in which the triangles use them; unused ones go.
void orderVertices(PartMesh& mesh) {
    std::vector<std::uint32_t> remap(mesh.positions.size());
    const std::size_t used = meshopt_optimizeVertexFetchRemap(remap.data(), mesh.indices.data(),
                                                              mesh.indices.size(), mesh.positions.size());
    const auto apply = [&](auto& values) {
        auto ordered = values;
        ordered.resize(used);
        for (std::size_t i = 0; i < remap.size(); ++i) {
            if (remap[i] != ~0u) ordered[remap[i]] = values[i];
        }
        values = std::move(ordered);
    };
    apply(mesh.positions);
    apply(mesh.normals);
    apply(mesh.uvs);
    if (!mesh.ambient.empty()) apply(mesh.ambient);
    for (std::uint32_t& index : mesh.indices) index = remap[index];
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::size_t appendPart(Scene& scene, PartMesh mesh, int material, const std::string& name) {
    dropTrianglesWithoutExtent(mesh);
    if (mesh.indices.empty()) return 0;
    if (mesh.uvs.empty()) mesh.uvs.resize(mesh.positions.size(), glm::vec2(0.0f));
    std::size_t repaired = 0;
    if (mesh.normals.empty()) {
        makeFlat(mesh);
    } else {
        repaired = repairNormals(mesh);
    }
    const std::vector<std::uint32_t> clusterSizes = clusterTriangles(mesh.positions, mesh.indices);
    orderVertices(mesh);

    Part part;
    part.name = name;
    part.material = material;
    part.firstTriangle = std::uint32_t(scene.triangleCount());
    part.triangleCount = std::uint32_t(mesh.indices.size() / 3);
    part.closed = isClosed(mesh.positions, mesh.indices);
    std::uint32_t local = 0;
    for (const std::uint32_t size : clusterSizes) {
        Cluster cluster{part.firstTriangle + local, size, std::uint32_t(scene.parts.size()), {}};
        for (std::uint32_t i = 3 * local; i < 3 * (local + size); ++i) {
            cluster.bounds.extend(glm::dvec3(mesh.positions[mesh.indices[i]]));
        }
        part.bounds.extend(cluster.bounds);
        scene.clusters.push_back(cluster);
        local += size;
    }
    scene.bounds.extend(part.bounds);
    scene.parts.push_back(part);

    const std::uint32_t firstVertex = std::uint32_t(scene.positions.size());
    append(scene.positions, mesh.positions);
    append(scene.normals, mesh.normals);
    append(scene.uvs, mesh.uvs);
    append(scene.ambient, mesh.ambient);
    for (const std::uint32_t index : mesh.indices) scene.indices.push_back(firstVertex + index);
    return repaired;
}

}  // namespace penumbra::gltf
