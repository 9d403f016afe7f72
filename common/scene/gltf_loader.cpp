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
#include "common/scene/gltf_placement.h"
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

[[noreturn]] void failEmpty(const Document& document) {
    const std::string why = document.notes.empty() ? "" : fmt::format(" ({})", document.notes.front());
    document.fail(fmt::format("holds no triangles: there is nothing to draw{}", why));
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
    if (scene.parts.empty()) failEmpty(document);
    if (!scene.ambient.empty() && scene.ambient.size() != scene.positions.size()) {
        document.note("baked ambient light is ignored: not every mesh has it");
        scene.ambient.clear();
    }
}

Scene buildScene(Document& document) {
    Scene scene;
    MaterialTable materials(document, scene);
    // First in the file's own space, to find out where the scene is; then relative to the origin near its
    // first camera.
    std::vector<PlacedNode> nodes = placeNodes(document, glm::dvec3(0.0));
    std::vector<Instance> instances = readInstances(document, nodes, materials);
    const Aabb bounds = boundsOf(instances, nodes);
    if (bounds.empty()) failEmpty(document);
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
