// Small meshes with known properties, for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra {

struct TestMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    void append(const TestMesh& other) {
        const auto first = std::uint32_t(positions.size());
        positions.insert(positions.end(), other.positions.begin(), other.positions.end());
        for (const std::uint32_t index : other.indices) indices.push_back(first + index);
    }
    void turnInsideOut() {
        for (std::size_t t = 0; t < indices.size(); t += 3) std::swap(indices[t + 1], indices[t + 2]);
    }
};

/// A closed ball of 2 * rings * sectors - 2 * sectors triangles, front outwards; every triangle has vertices
/// of its own.
inline TestMesh ball(const glm::vec3& centre, float radius, int rings, int sectors) {
    TestMesh mesh;
    const auto at = [&](int ring, int sector) {
        if (ring == 0 || ring == rings) return centre + glm::vec3(0, ring == 0 ? radius : -radius, 0);
        const double theta = 3.14159265358979 * ring / rings;
        const double phi = 6.28318530717959 * (sector % sectors) / sectors;
        return centre + radius * glm::vec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                           std::sin(theta) * std::cos(phi));
    };
    const auto triangle = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        for (const glm::vec3& p : {a, b, c}) {
            mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(p);
        }
    };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            if (r + 1 < rings) triangle(at(r, s), at(r + 1, s), at(r + 1, s + 1));
            if (r > 0) triangle(at(r, s), at(r + 1, s + 1), at(r, s + 1));
        }
    }
    return mesh;
}

}  // namespace penumbra
