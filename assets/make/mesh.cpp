#include "assets/make/mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <set>
#include <tuple>

namespace penumbra::assets {
namespace {

struct VectorLess {
    template <class V>
    bool operator()(const V& a, const V& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};

Vec3 scaledNormal(const Mesh& mesh, const glm::uvec3& t) {
    return glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
}

Vec3 roundedVector(const Vec3& v, double perUnit) {
    return {rounded(v.x, perUnit), rounded(v.y, perUnit), rounded(v.z, perUnit)};
}

bool isWithinEdge(const Vec3& p, const Vec3& a, const Vec3& b) {
    constexpr double tolerance = 1e-7;  // metres: a tenth of what positions are rounded to
    const Vec3 along = b - a;
    const double part = glm::dot(p - a, along) / glm::dot(along, along);
    return p != a && p != b && part > 0.0 && part < 1.0 && glm::length(p - a - part * along) < tolerance;
}

// A point lies within one edge of a triangle at most.
void cutTriangles(Mesh& mesh, const Vec3& p) {
    const auto added = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t before = mesh.triangles.size();
    for (std::size_t k = 0; k < before; ++k)
        for (int i = 0; i < 3; ++i) {
            const glm::uvec3 t = mesh.triangles[k];
            const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
            if (!isWithinEdge(p, mesh.positions[a], mesh.positions[b])) continue;
            mesh.triangles[k] = {a, added, c};
            mesh.triangles.push_back({added, b, c});
            break;
        }
    if (mesh.triangles.size() > before) mesh.positions.push_back(p);
}

}  // namespace

void Mesh::triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
}

void Mesh::quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
}

Mesh& Mesh::append(const Mesh& other, const Mat4& fromOther) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3& p : other.positions) positions.push_back(Vec3(fromOther * glm::dvec4(p, 1.0)));
    for (const glm::uvec3& t : other.triangles) triangles.push_back(t + first);
    return *this;
}

Mesh transformed(const Mesh& mesh, const Mat4& transform) {
    return Mesh().append(mesh, transform);
}

double rounded(double value, double perUnit) {
    return std::round(value * perUnit) / perUnit + 0.0;
}

Mesh welded(const Mesh& mesh) {
    Mesh result;
    std::map<Vec3, std::uint32_t, VectorLess> known;
    std::vector<std::uint32_t> newIndex;
    for (const Vec3& p : mesh.positions) {
        // Through float as well: two positions that the file cannot tell apart are one.
        const Vec3 key(glm::vec3(roundedVector(p, 1e6)));
        const auto next = static_cast<std::uint32_t>(result.positions.size());
        const auto [entry, isNew] = known.try_emplace(key, next);
        if (isNew) result.positions.push_back(key);
        newIndex.push_back(entry->second);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 n(newIndex[t.x], newIndex[t.y], newIndex[t.z]);
        if (n.x != n.y && n.y != n.z && n.z != n.x) result.triangles.push_back(n);
    }
    return result;
}

Mesh sharingVertices(const Mesh& mesh, const Mesh& neighbour) {
    Vec3 lower = mesh.positions.front(), upper = lower;
    for (const Vec3& p : mesh.positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
    Mesh result = mesh;
    for (const Vec3& p : neighbour.positions)
        if (glm::min(p, lower) == lower && glm::max(p, upper) == upper) cutTriangles(result, p);
    return welded(result);
}

bool isClosed(const Mesh& mesh) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            if (!edges.emplace(t[i], t[(i + 1) % 3]).second) return false;
    return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
        return edges.count({e.second, e.first}) == 1;
    });
}

double signedVolume(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles)
        sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z]));
    return sum / 6.0;
}

VertexData flatVertices(const Mesh& welded) {
    VertexData data;
    for (const Vec3& p : welded.positions) data.positions.emplace_back(p);
    for (const glm::uvec3& t : welded.triangles) data.indices.insert(data.indices.end(), {t.x, t.y, t.z});
    return data;
}

VertexData smoothVertices(const Mesh& welded, double creaseDegrees) {
    std::vector<std::vector<Vec3>> normalsAt(welded.positions.size());
    for (const glm::uvec3& t : welded.triangles)
        for (int i = 0; i < 3; ++i) normalsAt[t[i]].push_back(scaledNormal(welded, t));

    const double minimumCosine = std::cos(glm::radians(creaseDegrees));
    VertexData data;
    std::vector<std::map<Vec3, std::uint32_t, VectorLess>> known(welded.positions.size());
    for (const glm::uvec3& t : welded.triangles) {
        const Vec3 own = glm::normalize(scaledNormal(welded, t));
        for (int i = 0; i < 3; ++i) {
            Vec3 sum(0.0);
            for (const Vec3& n : normalsAt[t[i]])
                if (glm::dot(n, own) >= minimumCosine * glm::length(n)) sum += n;
            const Vec3 normal = roundedVector(glm::normalize(sum), 1e5);
            const auto next = static_cast<std::uint32_t>(data.positions.size());
            const auto [entry, isNew] = known[t[i]].try_emplace(normal, next);
            if (isNew) {
                data.positions.emplace_back(welded.positions[t[i]]);
                data.normals.emplace_back(normal);
            }
            data.indices.push_back(entry->second);
        }
    }
    return data;
}

Mat4 translation(const Vec3& offset) {
    return glm::translate(Mat4(1.0), offset);
}
Mat4 rotation(double degrees, const Vec3& axis) {
    return glm::rotate(Mat4(1.0), glm::radians(degrees), axis);
}
Mat4 scaling(const Vec3& factors) {
    return glm::scale(Mat4(1.0), factors);
}

}  // namespace penumbra::assets
