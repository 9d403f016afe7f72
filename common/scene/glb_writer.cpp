#include "common/scene/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/scene/glb_container.h"

namespace penumbra {

namespace {

using Json = nlohmann::ordered_json;

constexpr int wordType = 5125, floatType = 5126;  // componentType of uint32 and float
constexpr int vertexTarget = 34962, indexTarget = 34963;

template <class Vector>
Json jsonOf(const Vector& v) {
    return {v.x, v.y, v.z};
}

/// The file as it grows.
struct Glb {
    Json root;
    std::string bytes;

    int append(const char* list, const Json& value) {
        root[list].push_back(value);
        return int(root[list].size()) - 1;
    }
    template <class T>
    int accessor(const std::vector<T>& values, int target, int componentType, const char* type) {
        const std::size_t size = values.size() * sizeof(T);
        const int view =
            append("bufferViews",
                   {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}, {"target", target}});
        bytes.append(reinterpret_cast<const char*>(values.data()), size);
        return append("accessors", {{"bufferView", view},
                                    {"componentType", componentType},
                                    {"count", values.size()},
                                    {"type", type}});
    }
    /// In float, so a multiple of four bytes: everything stays aligned.
    template <class T>
    int attribute(const std::vector<T>& values, const char* type) {
        return accessor(values, vertexTarget, floatType, type);
    }
    void node(const Json& node) { root["scenes"][0]["nodes"].push_back(append("nodes", node)); }
};

Json materialJson(const Material& material) {
    // The inverse of what the loader makes of glTF's material (gltf_materials.cpp).
    const float specular = std::max({material.specular.x, material.specular.y, material.specular.z});
    const bool metal = specular > 0.05f && material.diffuse == glm::vec3(0.0f);
    const double roughness = std::pow(2.0 / (double(material.shininess) + 2.0), 0.25);
    Json json = {{"name", material.name}, {"doubleSided", material.doubleSided}};
    json["pbrMetallicRoughness"] = {{"metallicFactor", metal ? 1.0 : 0.0}, {"roughnessFactor", roughness}};
    Json colour = jsonOf(metal ? material.specular : material.diffuse);
    colour.push_back(1.0);
    json["pbrMetallicRoughness"]["baseColorFactor"] = colour;
    const glm::vec3& emission = material.emission;
    if (const float strength = std::max({emission.x, emission.y, emission.z}); strength > 0.0f) {
        json["emissiveFactor"] = jsonOf(emission / strength);
        json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    }
    return json;
}

/// The corners of one part, renumbered.
struct PartVertices {
    std::vector<std::uint32_t> sources, indices;

    PartVertices(const Scene& scene, const Part& part) {
        const auto first = scene.indices.begin() + 3 * std::ptrdiff_t(part.firstTriangle);
        indices.assign(first, first + 3 * std::ptrdiff_t(part.triangleCount));
        sources = indices;
        std::ranges::sort(sources);
        sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
        for (std::uint32_t& index : indices)
            index = std::uint32_t(std::ranges::lower_bound(sources, index) - sources.begin());
    }
    template <class T>
    auto gather(const T& values) const {
        std::vector<typename T::value_type> result;
        result.reserve(sources.size());
        for (const std::uint32_t source : sources) result.push_back(values[source]);
        return result;
    }
};

void addPart(const Scene& scene, const Part& part, std::span<const glm::vec4> ambient, Glb& glb) {
    const PartVertices vertices(scene, part);
    const std::vector<glm::vec3> positions = vertices.gather(scene.positions);
    std::vector<glm::vec3> bent;
    std::vector<float> visibility;
    for (const std::uint32_t source : vertices.sources) {
        bent.emplace_back(ambient[source]);
        visibility.push_back(ambient[source].w);
    }
    Aabb bounds;
    for (const glm::vec3& p : positions) bounds.extend(glm::dvec3(p));
    Json primitive = {{"material", part.material}};
    const int position = glb.attribute(positions, "VEC3");
    glb.root["accessors"].back()["min"] = jsonOf(bounds.lower);
    glb.root["accessors"].back()["max"] = jsonOf(bounds.upper);
    primitive["attributes"] = {{"POSITION", position},
                               {"NORMAL", glb.attribute(vertices.gather(scene.normals), "VEC3")},
                               {"TEXCOORD_0", glb.attribute(vertices.gather(scene.uvs), "VEC2")},
                               {"_AMBIENT_BENT", glb.attribute(bent, "VEC3")},
                               {"_AMBIENT_VISIBILITY", glb.attribute(visibility, "SCALAR")}};
    primitive["indices"] = glb.accessor(vertices.indices, indexTarget, wordType, "SCALAR");
    const int mesh = glb.append("meshes", {{"name", part.name}, {"primitives", Json::array({primitive})}});
    glb.node({{"name", part.name}, {"mesh", mesh}, {"translation", jsonOf(scene.origin)}});
}

/// A node at `position` that looks along `forward`.
Json placed(const std::string& name, const glm::dvec3& position, const glm::dvec3& forward,
            const glm::dvec3& up) {
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    const glm::dquat turn = glm::quat_cast(glm::dmat3(right, glm::cross(right, forward), -forward));
    Json node = {{"name", name}, {"translation", jsonOf(position)}};
    node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    return node;
}

void addCamera(const Scene& scene, const Camera& camera, Glb& glb) {
    Json json = {{"name", camera.name}, {"type", camera.orthographic ? "orthographic" : "perspective"}};
    if (camera.orthographic) {
        const double half = 0.5 * camera.height;
        json["orthographic"] = {{"xmag", half}, {"ymag", half}, {"znear", camera.near}, {"zfar", camera.far}};
    } else {
        json["perspective"] = {{"yfov", camera.verticalFov}, {"znear", camera.near}, {"zfar", camera.far}};
    }
    Json node = placed(camera.name, scene.origin + camera.position, camera.forward, camera.up);
    node["camera"] = glb.append("cameras", json);
    glb.node(node);
}

/// Area lights are meshes that glow, and already there.
void addLight(const Scene& scene, const Light& light, Json& lights, Glb& glb) {
    if (light.type == LightType::area) return;
    const double strength = std::max({light.emission.x, light.emission.y, light.emission.z});
    Json json = {{"name", light.name},
                 {"type", light.type == LightType::point  ? "point"
                          : light.type == LightType::spot ? "spot"
                                                          : "directional"},
                 {"color", jsonOf(strength > 0.0 ? light.emission / strength : glm::dvec3(1.0))},
                 {"intensity", strength}};
    if (light.type == LightType::spot)
        json["spot"] = {{"innerConeAngle", light.innerCone}, {"outerConeAngle", light.outerCone}};
    const glm::dvec3 up = std::abs(light.direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    Json node = placed(light.name, scene.origin + light.position, light.direction, up);
    node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
    lights.push_back(json);
    glb.node(node);
}

}  // namespace

std::string glbOf(const Scene& scene, std::span<const glm::vec4> ambient) {
    Glb glb;
    glb.root["asset"] = {{"version", "2.0"}, {"generator", "Penumbra"}};
    glb.root["scene"] = 0;
    glb.root["scenes"] = Json::array({{{"name", scene.name}, {"nodes", Json::array()}}});
    for (const Material& material : scene.materials) glb.append("materials", materialJson(material));
    for (const Part& part : scene.parts) addPart(scene, part, ambient, glb);
    for (const Camera& camera : scene.cameras) addCamera(scene, camera, glb);
    Json lights = Json::array();
    for (const Light& light : scene.lights) addLight(scene, light, lights, glb);
    Json used = {"KHR_materials_emissive_strength"};
    if (!lights.empty()) {
        glb.root["extensions"]["KHR_lights_punctual"]["lights"] = lights;
        used.push_back("KHR_lights_punctual");
    }
    glb.root["extensionsUsed"] = used;
    glb.root["buffers"] = Json::array({{{"byteLength", glb.bytes.size()}}});
    return glbContainer(glb.root.dump(-1, ' ', false, Json::error_handler_t::replace), glb.bytes);
}

}  // namespace penumbra
