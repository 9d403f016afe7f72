#include "common/scene/gltf_loader.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>

#include "common/error.h"
#include "common/scene/area_lights.h"
#include "common/scene/gltf_document.h"
#include "common/scene/gltf_flatten.h"
#include "common/scene/gltf_limits.h"
#include "common/scene/gltf_materials.h"
#include "common/scene/gltf_mesh.h"
#include "common/scene/gltf_nodes.h"
#include "common/scene/gltf_views.h"
#include "common/scene/scene_defaults.h"

namespace penumbra {
namespace gltf {
namespace {

struct Instance {
    std::size_t placed = 0;  ///< index into the placed nodes
    std::string name;
    int material = -1;  ///< glTF's
    LocalMesh mesh;
};

glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p) {
    return glm::dvec3(m * glm::dvec4(p, 1.0));
}

/// Reads the mesh of every placed node, primitive by primitive.
std::vector<Instance> readInstances(Document& document, const std::vector<PlacedNode>& nodes,
                                    const MaterialTable& materials) {
    const auto& meshes = document.model->meshes;
    std::vector<Instance> instances;
    std::size_t triangles = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const tinygltf::Node& node = document.model->nodes[std::size_t(nodes[n].node)];
        if (node.mesh == -1) continue;
        const std::string name = nodeName(document, nodes[n].node);
        if (node.mesh < 0 || std::size_t(node.mesh) >= meshes.size()) {
            document.fail(
                fmt::format("{} refers to mesh {}, and there are {}", name, node.mesh, meshes.size()));
        }
        if (node.skin >= 0) document.note("skins are ignored: meshes are shown in their bind pose");
        const auto& primitives = meshes[std::size_t(node.mesh)].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const int material = primitives[p].material;
            auto mesh = readPrimitive(document, node.mesh, int(p), materials.textureUse(material).texCoord);
            if (!mesh) continue;
            triangles += mesh->indices.size() / 3;
            if (triangles > maxTriangles) {
                document.fail(
                    fmt::format("more than {} million triangles, counted per use of a mesh: split the scene",
                                maxTriangles / 1'000'000));
            }
            instances.push_back({n, name, material, std::move(*mesh)});
        }
    }
    return instances;
}

Aabb boundsOf(const std::vector<Instance>& instances, const std::vector<PlacedNode>& nodes) {
    Aabb bounds;
    for (const Instance& instance : instances) {
        for (const glm::vec3& p : instance.mesh.positions) {
            bounds.extend(transformPoint(nodes[instance.placed].sceneFromNode, p));
        }
    }
    return bounds;
}

/// A point near `view`, on a grid of a power of two metres, about four times the radius of the scene and at
/// most 64.
///
/// Why a grid: if the scene moves by a multiple of the grid step, the origin moves by exactly as much, every
/// difference to it is the same, and so is every float. 1e6 = 2^6 * 15625 is a multiple of every step up
/// to 64. With the view itself as origin, the rounding of its coordinate out there (6e-11 m at 1e6) would
/// shift everything, and one float in some hundred would come out another one. Why four times: an ordinary
/// scene around its file's origin then keeps the file's own numbers. What the grid costs is a few bits of
/// float precision at most, since |p| stays below about three radii.
glm::dvec3 chooseOrigin(const glm::dvec3& view, double radius) {
    // The factor 1.37 and the shift 0.382 keep round numbers (a radius of 2, a camera at 4) away from where
    // the rounding flips, since such a number may be off by a rounding error in the moved scene.
    const double exponent = std::floor(std::log2(4.0 * 1.37 * std::max(radius, 1e-6)));
    const double step = std::exp2(std::min(exponent, 6.0));
    return glm::floor(view / step + 0.382) * step;
}

PartMesh placeMesh(LocalMesh&& local, const glm::dmat4& sceneFromMesh, const glm::dmat3& uvFromFile) {
    PartMesh mesh;
    mesh.indices = std::move(local.indices);
    mesh.positions = std::move(local.positions);
    for (glm::vec3& p : mesh.positions) p = glm::vec3(transformPoint(sceneFromMesh, p));
    const glm::dmat3 linear(sceneFromMesh);
    const bool mirrored = glm::determinant(linear) < 0.0;
    // The cofactor matrix takes normals along without an inverse; a mirror turns it inside out.
    glm::dmat3 normalMatrix(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
    if (mirrored) normalMatrix *= -1.0;
    // Kept in range of float whatever the scale of the node.
    const double size =
        std::max({glm::length(normalMatrix[0]), glm::length(normalMatrix[1]), glm::length(normalMatrix[2])});
    if (size > 0.0) normalMatrix /= size;
    mesh.normals = std::move(local.normals);
    for (glm::vec3& n : mesh.normals) n = glm::vec3(normalMatrix * glm::dvec3(n));
    mesh.uvs = std::move(local.uvs);
    for (glm::vec2& uv : mesh.uvs) uv = glm::vec2(uvFromFile * glm::dvec3(uv, 1.0));
    for (std::size_t t = 0; mirrored && t < mesh.indices.size(); t += 3)
        std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
    return mesh;
}

void requireFloats(const Document& document, const PartMesh& mesh, const std::string& name) {
    for (const glm::vec3& p : mesh.positions) {
        // Squares of coordinates are formed in float in shaders: beyond this they overflow.
        const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (!(largest < 1e15f)) {
            document.fail(
                fmt::format("{} is more than 1e15 m away from the camera; scale the scene down", name));
        }
    }
}

void flatten(Document& document, std::vector<Instance>& instances, const std::vector<PlacedNode>& nodes,
             MaterialTable& materials, Scene& scene) {
    std::size_t repaired = 0;
    for (Instance& instance : instances) {
        const TextureUse use = materials.textureUse(instance.material);
        PartMesh mesh =
            placeMesh(std::move(instance.mesh), nodes[instance.placed].sceneFromNode, use.uvFromFile);
        requireFloats(document, mesh, instance.name);
        if (mesh.indices.empty()) continue;
        repaired +=
            appendPart(scene, std::move(mesh), materials.sceneMaterial(instance.material), instance.name);
    }
    if (repaired > 0) document.note(fmt::format("{} normals had no direction and were replaced", repaired));
    if (scene.parts.empty()) document.fail("holds no triangles: there is nothing to draw");
}

Scene buildScene(Document& document) {
    Scene scene;
    MaterialTable materials(document, scene);
    // First in the file's own space, to find out where the scene is; then relative to the origin near its
    // first camera.
    std::vector<PlacedNode> nodes = placeNodes(document, glm::dvec3(0.0));
    std::vector<Instance> instances = readInstances(document, nodes, materials);
    const Aabb bounds = boundsOf(instances, nodes);
    if (bounds.empty()) document.fail("holds no triangles: there is nothing to draw");
    addCameras(document, nodes, scene);
    const glm::dvec3 view = scene.cameras.empty() ? bounds.centre() : scene.cameras[0].position;
    scene.cameras.clear();

    scene.origin = chooseOrigin(view, bounds.radius());
    nodes = placeNodes(document, scene.origin);
    flatten(document, instances, nodes, materials, scene);
    addCameras(document, nodes, scene);
    addPunctualLights(document, nodes, scene);
    scene.notes = document.notes;
    addAreaLights(scene);
    addFittedCamera(scene);
    finishCameras(scene);
    addSun(scene);
    return scene;
}

}  // namespace
}  // namespace gltf

Scene loadGltfFromMemory(const std::vector<std::uint8_t>& bytes, const std::string& name,
                         const std::filesystem::path& baseDirectory) {
    gltf::Document document = gltf::parseDocument(bytes, name, baseDirectory);
    Scene scene = gltf::buildScene(document);
    scene.name = name;
    scene.source = name;
    return scene;
}

Scene loadGltf(const std::filesystem::path& file) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        throw Error(fmt::format("{}: no such file; give the path of a .gltf or .glb file", file.string()));
    }
    const std::uint64_t size = fs::file_size(file, error);
    if (error || size > gltf::maxFileBytes)
        throw Error(file.string() + ": larger than 2 GiB; split the scene");
    std::vector<std::uint8_t> bytes(size);
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) {
        throw Error(file.string() + ": cannot be read; check its permissions");
    }
    const fs::path directory = file.has_parent_path() ? file.parent_path() : fs::path(".");
    Scene scene = loadGltfFromMemory(bytes, file.string(), directory);
    scene.name = file.stem().string();
    scene.source = file.string();
    return scene;
}

}  // namespace penumbra
