#include "common/scene/gltf_materials.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "common/image/image_file.h"
#include "common/scene/gltf_limits.h"
#include "common/scene/gltf_uri.h"

namespace penumbra::gltf {
namespace {

glm::vec3 rgb(const std::vector<double>& values, const glm::vec3& fallback) {
    return values.size() < 3 ? fallback : glm::vec3(values[0], values[1], values[2]);
}

bool isGiven(const tinygltf::Material& material, const char* name) {
    return material.values.count(name) > 0;
}

/// A number of an extension object, or the fallback.
double number(const tinygltf::Value& object, const char* key, double fallback) {
    return object.Has(key) && object.Get(key).IsNumber() ? object.Get(key).GetNumberAsDouble() : fallback;
}

glm::dvec2 pair(const tinygltf::Value& object, const char* key, const glm::dvec2& fallback) {
    if (!object.Has(key)) return fallback;
    const tinygltf::Value& array = object.Get(key);
    if (!array.IsArray() || array.ArrayLen() != 2 || !array.Get(0).IsNumber() || !array.Get(1).IsNumber()) {
        return fallback;
    }
    return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: uv' = translation * rotation * scale * uv.
glm::dmat3 textureTransform(const tinygltf::Value& extension) {
    const glm::dvec2 offset = pair(extension, "offset", {0, 0});
    const glm::dvec2 scale = pair(extension, "scale", {1, 1});
    const double angle = number(extension, "rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    return {{c * scale.x, -s * scale.x, 0}, {s * scale.y, c * scale.y, 0}, {offset, 1}};
}

/// Fraction of the surface that is metal. glTF's default is 1, which turns every file that leaves it out, or
/// puts it in a texture we don't read, into black iron: then 0 is taken.
float metalness(const tinygltf::Material& material) {
    const bool textured = material.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0;
    if (textured || !isGiven(material, "metallicFactor")) return 0.0f;
    return glm::clamp(float(material.pbrMetallicRoughness.metallicFactor), 0.0f, 1.0f);
}

/// The Blinn-Phong lobe as wide as a microfacet lobe of alpha = roughness^2: exponent 2 / alpha^2 - 2
/// (Walter, Marschner, Li & Torrance, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007).
float shininess(double roughness) {
    const double alpha = roughness * roughness;
    return float(std::clamp(2.0 / std::max(alpha * alpha, 1e-8) - 2.0, 1.0, 10000.0));
}

}  // namespace

int MaterialTable::sceneMaterial(int gltfMaterial) {
    if (gltfMaterial < -1 || gltfMaterial >= int(document_.model->materials.size())) {
        document_.fail(fmt::format("a mesh refers to material {}, and there are {}", gltfMaterial,
                                   document_.model->materials.size()));
    }
    const auto [entry, isNew] = materials_.try_emplace(gltfMaterial, int(scene_.materials.size()));
    if (isNew) {
        Material material;
        if (gltfMaterial >= 0) material = convert(gltfMaterial);
        scene_.materials.push_back(material);
    }
    return entry->second;
}

TextureUse MaterialTable::textureUse(int gltfMaterial) const {
    TextureUse use;
    if (gltfMaterial < 0 || gltfMaterial >= int(document_.model->materials.size())) return use;
    const auto& info =
        document_.model->materials[std::size_t(gltfMaterial)].pbrMetallicRoughness.baseColorTexture;
    use.texCoord = info.texCoord;
    const auto transform = info.extensions.find("KHR_texture_transform");
    if (transform == info.extensions.end()) return use;
    use.uvFromFile = textureTransform(transform->second);
    use.texCoord = int(number(transform->second, "texCoord", info.texCoord));
    return use;
}

Material MaterialTable::convert(int gltfMaterial) {
    const tinygltf::Material& source = document_.model->materials[std::size_t(gltfMaterial)];
    const auto& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name =
        source.name.empty() ? fmt::format("material {}", gltfMaterial) : printable(source.name, 80);
    const glm::vec3 base = glm::clamp(rgb(pbr.baseColorFactor, glm::vec3(1.0f)), 0.0f, 1.0f);
    const float metal = metalness(source);
    material.diffuse = base * (1.0f - metal);
    material.specular = glm::mix(glm::vec3(0.04f), base, metal);
    material.shininess = shininess(glm::clamp(pbr.roughnessFactor, 0.0, 1.0));
    material.doubleSided = source.doubleSided;
    if (pbr.baseColorTexture.index >= 0) {
        material.diffuseTexture = sceneTexture(pbr.baseColorTexture.index, material.name);
    }
    if (pbr.metallicRoughnessTexture.index >= 0) document_.note("metallic-roughness textures are ignored");
    if (source.normalTexture.index >= 0) document_.note("normal maps are ignored");
    if (source.alphaMode != "OPAQUE") document_.note("alpha is ignored: every surface is opaque");
    if (source.emissiveTexture.index >= 0) {
        document_.note("emissive textures are ignored: those surfaces do not glow");
        return material;
    }
    double strength = 1.0;
    const auto extension = source.extensions.find("KHR_materials_emissive_strength");
    if (extension != source.extensions.end()) strength = number(extension->second, "emissiveStrength", 1.0);
    material.emission =
        glm::max(rgb(source.emissiveFactor, glm::vec3(0.0f)), 0.0f) * float(std::clamp(strength, 0.0, 1e12));
    return material;
}

int MaterialTable::sceneTexture(int gltfTexture, const std::string& who) {
    const auto& textures = document_.model->textures;
    if (std::size_t(gltfTexture) >= textures.size()) {
        document_.fail(
            fmt::format("{} refers to texture {}, and there are {}", who, gltfTexture, textures.size()));
    }
    const int image = textures[std::size_t(gltfTexture)].source;
    if (image < 0) {
        document_.note(fmt::format("texture {} has no PNG or JPEG image and is ignored", gltfTexture));
        return -1;
    }
    if (std::size_t(image) >= document_.images.size()) {
        document_.fail(fmt::format("texture {} refers to image {}, and there are {}", gltfTexture, image,
                                   document_.images.size()));
    }
    const auto known = images_.find(image);
    if (known != images_.end()) return known->second;
    const int texture = decode(image, fmt::format("image {}", image));
    images_[image] = texture;
    return texture;
}

int MaterialTable::decode(int image, const std::string& who) {
    const ImageSource& source = document_.images[std::size_t(image)];
    std::vector<std::uint8_t> fetched;
    Bytes bytes;
    if (source.uri.empty()) {
        bytes = document_.viewBytes(source.bufferView, who);
    } else {
        fetched = fetchUri(source.uri, document_, who);
        bytes = fetched;
    }
    const std::string name = printable(document_.name, 200) + ": " + who;
    DecodedImage decoded = decodeImage(bytes.data(), bytes.size(), name, maxTexturePixels - texturePixels_);
    texturePixels_ += std::size_t(decoded.width) * std::size_t(decoded.height);
    scene_.textures.push_back({decoded.width, decoded.height, std::move(decoded.rgba)});
    return int(scene_.textures.size()) - 1;
}

}  // namespace penumbra::gltf
