#include "common/scene/gltf_mesh.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cmath>
#include <numeric>

#include "common/scene/gltf_accessor.h"

namespace penumbra::gltf {
namespace {

/// Corner `k` of triangle `i` as a position in the list of vertices (glTF 2.0, 3.7.2.1).
std::size_t cornerOf(int mode, std::size_t i, std::size_t k) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        const std::size_t odd = i % 2;
        return k == 0 ? i : k == 1 ? i + 1 + odd : i + 2 - odd;
    }
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return k == 2 ? 0 : i + 1 + k;
    return 3 * i + k;
}

/// A triangle list from the vertex list of a primitive. A triangle that uses a vertex twice (the joints of
/// strips) covers nothing and is left out.
std::vector<std::uint32_t> triangleList(const std::vector<std::uint32_t>& list, int mode) {
    const bool plain = mode == TINYGLTF_MODE_TRIANGLES;
    const std::size_t count = plain ? list.size() / 3 : list.size() < 3 ? 0 : list.size() - 2;
    std::vector<std::uint32_t> triangles;
    triangles.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t a = list[cornerOf(mode, i, 0)];
        const std::uint32_t b = list[cornerOf(mode, i, 1)];
        const std::uint32_t c = list[cornerOf(mode, i, 2)];
        if (a != b && b != c && c != a) triangles.insert(triangles.end(), {a, b, c});
    }
    return triangles;
}

template <class Vector>
void gather(std::vector<Vector>& values, const std::vector<std::uint32_t>& sources) {
    if (values.empty()) return;
    std::vector<Vector> gathered;
    gathered.reserve(sources.size());
    for (const std::uint32_t source : sources) gathered.push_back(values[source]);
    values = std::move(gathered);
}

/// Keeps the vertices that are used, in the order of first use: a part of three vertices may point into an
/// accessor of millions.
void dropUnusedVertices(LocalMesh& mesh) {
    constexpr std::uint32_t unused = ~std::uint32_t(0);
    std::vector<std::uint32_t> newIndex(mesh.positions.size(), unused);
    std::vector<std::uint32_t> sources;
    for (std::uint32_t& index : mesh.indices) {
        if (newIndex[index] == unused) {
            newIndex[index] = std::uint32_t(sources.size());
            sources.push_back(index);
        }
        index = newIndex[index];
    }
    gather(mesh.positions, sources);
    gather(mesh.normals, sources);
    gather(mesh.uvs, sources);
    gather(mesh.ambient, sources);
}

int attributeOf(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

bool usesQuantization(const Document& document) {
    for (const std::string& name : document.model->extensionsUsed) {
        if (name == "KHR_mesh_quantization") return true;
    }
    return false;
}

std::vector<std::uint32_t> vertexList(Document& document, const tinygltf::Primitive& primitive,
                                      std::size_t vertexCount, const std::string& who) {
    if (primitive.indices < 0) {
        std::vector<std::uint32_t> all(vertexCount);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    std::vector<std::uint32_t> list = readIndices(document, primitive.indices, who + " indices");
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i] >= vertexCount) {
            document.fail(fmt::format("{}: index number {} is {}, and there are {} vertices", who, i, list[i],
                                      vertexCount));
        }
    }
    return list;
}

void requireFinite(const Document& document, const std::vector<glm::vec3>& positions,
                   const std::string& who) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3& p = positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            document.fail(
                fmt::format("{}: position {} is ({}, {}, {}), not a point in space", who, i, p.x, p.y, p.z));
        }
    }
}

template <class Vector>
void requireCount(const Document& document, const std::vector<Vector>& values, std::size_t count,
                  const std::string& who) {
    if (!values.empty() && values.size() != count) {
        document.fail(fmt::format("{}: {} values for {} vertices", who, values.size(), count));
    }
}

/// Baked ambient light; nothing unless both attributes are there.
std::vector<glm::vec4> readAmbient(Document& document, const tinygltf::Primitive& primitive,
                                   std::size_t count, const std::string& who) {
    const int bent = attributeOf(primitive, "_AMBIENT_BENT");
    const int visibility = attributeOf(primitive, "_AMBIENT_VISIBILITY");
    if (bent < 0 || visibility < 0) return {};
    const auto bents = readVec3(document, bent, Integers::no, who + " _AMBIENT_BENT");
    const auto visibilities = readScalars(document, visibility, Integers::no, who + " _AMBIENT_VISIBILITY");
    requireCount(document, bents, count, who + " _AMBIENT_BENT");
    requireCount(document, visibilities, count, who + " _AMBIENT_VISIBILITY");
    std::vector<glm::vec4> ambient;
    for (std::size_t i = 0; i < bents.size() && i < visibilities.size(); ++i) {
        ambient.emplace_back(bents[i], visibilities[i].x);
        const glm::vec4& a = ambient.back();
        if (!std::isfinite(a.x + a.y + a.z + a.w))
            document.fail(fmt::format("{}: baked ambient light {} is ({}, {}, {}, {}), not finite", who, i,
                                      a.x, a.y, a.z, a.w));
    }
    return ambient;
}

void readAttributes(Document& document, const tinygltf::Primitive& primitive, int texCoord,
                    const std::string& who, LocalMesh& mesh) {
    const bool quantized = usesQuantization(document);
    mesh.positions = readVec3(document, attributeOf(primitive, "POSITION"),
                              quantized ? Integers::any : Integers::no, who + " POSITION");
    requireFinite(document, mesh.positions, who);
    if (const int normal = attributeOf(primitive, "NORMAL"); normal >= 0) {
        mesh.normals = readVec3(document, normal, quantized ? Integers::any : Integers::no, who + " NORMAL");
        requireCount(document, mesh.normals, mesh.positions.size(), who + " NORMAL");
    }
    const std::string texCoordName = fmt::format("TEXCOORD_{}", texCoord);
    if (const int uv = attributeOf(primitive, texCoordName); uv >= 0) {
        mesh.uvs = readVec2(document, uv, quantized ? Integers::any : Integers::normalizedUnsigned,
                            who + " " + texCoordName);
        requireCount(document, mesh.uvs, mesh.positions.size(), who + " " + texCoordName);
    }
    mesh.ambient = readAmbient(document, primitive, mesh.positions.size(), who);
    if (primitive.attributes.count("COLOR_0") > 0) document.note("vertex colours are ignored");
    if (!primitive.targets.empty()) document.note("morph targets are ignored");
}

}  // namespace

std::optional<LocalMesh> readPrimitive(Document& document, int mesh, int primitiveIndex, int texCoord) {
    const tinygltf::Primitive& primitive =
        document.model->meshes[std::size_t(mesh)].primitives[std::size_t(primitiveIndex)];
    const std::string who = fmt::format("mesh {} primitive {}", mesh, primitiveIndex);
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        document.fail(
            fmt::format("{}: mode {} is none of 0 (points) to 6 (triangle fan)", who, primitive.mode));
    }
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        document.note("points and lines are skipped: they have no area to throw a shadow");
        return std::nullopt;
    }
    if (attributeOf(primitive, "POSITION") < 0) {
        document.note(fmt::format("{} has no positions and is skipped", who));
        return std::nullopt;
    }
    LocalMesh result;
    readAttributes(document, primitive, texCoord, who, result);
    const std::vector<std::uint32_t> list = vertexList(document, primitive, result.positions.size(), who);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && list.size() % 3 != 0) {
        document.note(fmt::format("{}: the last {} of {} vertices make no triangle", who, list.size() % 3,
                                  list.size()));
    }
    result.indices = triangleList(list, primitive.mode);
    dropUnusedVertices(result);
    return result;
}

}  // namespace penumbra::gltf
