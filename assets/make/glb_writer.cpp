#include "assets/make/glb_writer.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/error.h"
#include "common/image/file_write.h"
#include "common/scene/glb_container.h"

namespace penumbra::assets {
namespace {

using Json = nlohmann::ordered_json;

constexpr int shortType = 5123, wordType = 5125, floatType = 5126;  // componentType of uint16, uint32, float
constexpr int vertexTarget = 34962, indexTarget = 34963;

Json jsonVector(const Vec3& v, double perUnit = 1e6) {
    return {rounded(v.x, perUnit), rounded(v.y, perUnit), rounded(v.z, perUnit)};
}

Vec3 lowest(const std::vector<glm::vec3>& points) {
    glm::vec3 result = points[0];
    for (const glm::vec3& p : points) result = glm::min(result, p);
    return result;
}

Vec3 highest(const std::vector<glm::vec3>& points) {
    glm::vec3 result = points[0];
    for (const glm::vec3& p : points) result = glm::max(result, p);
    return result;
}

}  // namespace

Pose at(const Vec3& position) {
    return {position};
}

Pose turned(const Vec3& position, double degrees, const Vec3& axis, double scale) {
    return {position, glm::angleAxis(glm::radians(degrees), glm::normalize(axis)), Vec3(scale)};
}

Pose looking(const Vec3& position, const Vec3& target) {
    const Vec3 forward = glm::normalize(target - position);
    const Vec3 roughlyUp = std::abs(forward.y) < 0.999 ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
    const Vec3 right = glm::normalize(glm::cross(forward, roughlyUp));
    return {position, glm::quat_cast(glm::dmat3(right, glm::cross(right, forward), -forward))};
}

struct GlbWriter::State {
    Json root;
    Json lights = Json::array();
    std::vector<char> bytes;
    bool emissive = false;

    int append(const char* list, const Json& value) {
        root[list].push_back(value);
        return static_cast<int>(root[list].size()) - 1;
    }

    int view(const void* data, std::size_t count, int target) {
        const std::size_t offset = bytes.size();
        bytes.resize((offset + count + 3) / 4 * 4, 0);
        std::memcpy(bytes.data() + offset, data, count);
        return append("bufferViews",
                      {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", count}, {"target", target}});
    }

    int vectors(const std::vector<glm::vec3>& values, bool withBounds) {
        const int index = view(values.data(), values.size() * sizeof(glm::vec3), vertexTarget);
        Json accessor = {
            {"bufferView", index}, {"componentType", floatType}, {"count", values.size()}, {"type", "VEC3"}};
        if (withBounds) {
            // Enough digits to give back the same float: the format asks for exact bounds.
            const Vec3 low = lowest(values), high = highest(values);
            accessor["min"] = {low.x, low.y, low.z};
            accessor["max"] = {high.x, high.y, high.z};
        }
        return append("accessors", accessor);
    }

    int indices(const std::vector<std::uint32_t>& values, std::size_t vertexCount) {
        const bool isShort = vertexCount < 65535;
        const std::vector<std::uint16_t> narrow(values.begin(), values.end());
        const int index = isShort ? view(narrow.data(), narrow.size() * 2, indexTarget)
                                  : view(values.data(), values.size() * 4, indexTarget);
        return append("accessors", {{"bufferView", index},
                                    {"componentType", isShort ? shortType : wordType},
                                    {"count", values.size()},
                                    {"type", "SCALAR"}});
    }

    int node(const std::string& name, int parent, Json node) {
        node["name"] = name;
        const int index = append("nodes", node);
        if (parent < 0) {
            root["scenes"][0]["nodes"].push_back(index);
        } else {
            root["nodes"][static_cast<std::size_t>(parent)]["children"].push_back(index);
        }
        return index;
    }

    void light(const std::string& name, const Pose& pose, Json light);
};

namespace {

Json poseJson(const Pose& pose) {
    Json node = Json::object();
    if (pose.position != Vec3(0.0)) node["translation"] = jsonVector(pose.position);
    if (pose.rotation != glm::dquat(1, 0, 0, 0)) {
        node["rotation"] = {rounded(pose.rotation.x, 1e7), rounded(pose.rotation.y, 1e7),
                            rounded(pose.rotation.z, 1e7), rounded(pose.rotation.w, 1e7)};
    }
    if (pose.scale != Vec3(1.0)) node["scale"] = jsonVector(pose.scale);
    return node;
}

// glTF splits a light into a colour in [0, 1] and an intensity.
Json colouredLight(const char* type, const Vec3& emission) {
    const double strength = std::max({emission.x, emission.y, emission.z});
    return {{"type", type}, {"color", jsonVector(emission / strength)}, {"intensity", strength}};
}

}  // namespace

void GlbWriter::State::light(const std::string& name, const Pose& pose, Json light) {
    light["name"] = name;
    lights.push_back(light);
    Json holder = poseJson(pose);
    holder["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    node(name, -1, holder);
}

GlbWriter::GlbWriter(const std::string& about) : state_(std::make_unique<State>()) {
    state_->root["asset"] = {{"version", "2.0"},
                             {"generator", "Penumbra make_assets"},
                             {"copyright", "CC0 1.0: no rights reserved"}};
    state_->root["scene"] = 0;
    state_->root["scenes"] = Json::array({{{"name", about}, {"nodes", Json::array()}}});
}

GlbWriter::GlbWriter(GlbWriter&& other) noexcept = default;
GlbWriter::~GlbWriter() = default;

int GlbWriter::material(const MaterialDescription& description) {
    Json material = {{"name", description.name}};
    material["pbrMetallicRoughness"] = {
        {"baseColorFactor", {description.colour.x, description.colour.y, description.colour.z, 1.0}},
        {"metallicFactor", 0.0},
        {"roughnessFactor", description.roughness}};
    if (description.doubleSided) material["doubleSided"] = true;
    const Vec3& radiance = description.radiance;
    if (const double strength = std::max({radiance.x, radiance.y, radiance.z}); strength > 0.0) {
        material["emissiveFactor"] = jsonVector(radiance / strength);
        material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
        state_->emissive = true;
    }
    return state_->append("materials", material);
}

int GlbWriter::mesh(const std::string& name, const std::vector<PartDescription>& parts) {
    Json primitives = Json::array();
    for (const PartDescription& part : parts) {
        const Mesh mesh = welded(part.mesh);
        if (part.surface == Surface::closed && (!isClosed(mesh) || signedVolume(mesh) <= 0.0))
            throw Error("mesh " + name + " should be closed, but has a hole or is inside out");
        const VertexData data =
            part.creaseDegrees > 0.0 ? smoothVertices(mesh, part.creaseDegrees) : flatVertices(mesh);
        Json primitive;
        primitive["attributes"]["POSITION"] = state_->vectors(data.positions, true);
        if (!data.normals.empty()) primitive["attributes"]["NORMAL"] = state_->vectors(data.normals, false);
        primitive["indices"] = state_->indices(data.indices, data.positions.size());
        primitive["material"] = part.material;
        primitives.push_back(primitive);
    }
    return state_->append("meshes", {{"name", name}, {"primitives", primitives}});
}

int GlbWriter::group(const std::string& name, const Pose& pose, int parent) {
    return state_->node(name, parent, poseJson(pose));
}

int GlbWriter::place(const std::string& name, int mesh, const Pose& pose, int parent) {
    Json node = poseJson(pose);
    node["mesh"] = mesh;
    return state_->node(name, parent, node);
}

int GlbWriter::placeByMatrix(const std::string& name, int mesh, const Mat4& parentFromMesh, int parent) {
    Json node = {{"mesh", mesh}, {"matrix", Json::array()}};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) node["matrix"].push_back(rounded(parentFromMesh[column][row], 1e7));
    return state_->node(name, parent, node);
}

int GlbWriter::add(const std::string& name, const PartDescription& part, const Pose& pose, int parent) {
    return place(name, mesh(name, {part}), pose, parent);
}

void GlbWriter::sun(const std::string& name, const Vec3& direction, const Vec3& irradiance) {
    state_->light(name, looking(-10.0 * glm::normalize(direction), Vec3(0.0)),
                  colouredLight("directional", irradiance));
}

void GlbWriter::point(const std::string& name, const Vec3& position, const Vec3& intensity) {
    state_->light(name, at(position), colouredLight("point", intensity));
}

void GlbWriter::spot(const std::string& name, const Pose& pose, const Vec3& intensity, double innerDegrees,
                     double outerDegrees) {
    Json light = colouredLight("spot", intensity);
    light["spot"] = {{"innerConeAngle", rounded(glm::radians(innerDegrees), 1e7)},
                     {"outerConeAngle", rounded(glm::radians(outerDegrees), 1e7)}};
    state_->light(name, pose, light);
}

void GlbWriter::camera(const std::string& name, const Pose& pose, double verticalFovDegrees,
                       double nearDistance, double farDistance) {
    Json holder = poseJson(pose);
    holder["camera"] = state_->append("cameras", {{"name", name},
                                                  {"type", "perspective"},
                                                  {"perspective",
                                                   {{"yfov", rounded(glm::radians(verticalFovDegrees), 1e7)},
                                                    {"znear", nearDistance},
                                                    {"zfar", farDistance}}}});
    state_->node(name, -1, holder);
}

void GlbWriter::orthographicCamera(const std::string& name, const Pose& pose, double height,
                                   double nearDistance, double farDistance) {
    Json holder = poseJson(pose);
    holder["camera"] = state_->append(
        "cameras",
        {{"name", name},
         {"type", "orthographic"},
         {"orthographic",
          {{"xmag", 0.5 * height}, {"ymag", 0.5 * height}, {"znear", nearDistance}, {"zfar", farDistance}}}});
    state_->node(name, -1, holder);
}

void GlbWriter::extras(const std::string& json) {
    state_->root["scenes"][0]["extras"] = Json::parse(json);
}

void GlbWriter::write(const std::filesystem::path& file) const {
    Json root = state_->root;
    Json used = Json::array();
    if (!state_->lights.empty()) {
        root["extensions"]["KHR_lights_punctual"]["lights"] = state_->lights;
        used.push_back("KHR_lights_punctual");
    }
    if (state_->emissive) used.push_back("KHR_materials_emissive_strength");
    if (!used.empty()) root["extensionsUsed"] = used;
    root["buffers"] = Json::array({{{"byteLength", state_->bytes.size()}}});

    writeFile(file, glbContainer(root.dump(), {state_->bytes.data(), state_->bytes.size()}));
}

}  // namespace penumbra::assets
