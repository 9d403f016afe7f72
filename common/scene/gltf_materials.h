// glTF's metallic-roughness materials as Blinn-Phong. Internal to the loader.
#pragma once

#include <glm/glm.hpp>
#include <map>

#include "common/scene/gltf_document.h"
#include "common/scene/scene.h"

namespace penumbra::gltf {

/// How a material reads its base colour texture.
struct TextureUse {
    int texCoord = 0;            ///< which TEXCOORD set
    glm::dmat3 uvFromFile{1.0};  ///< KHR_texture_transform, applied to the vertices once and for all
};

/// Converts the materials that are used, each once, and decodes the textures they need, each once.
class MaterialTable {
 public:
    MaterialTable(Document& document, Scene& scene) : document_(document), scene_(scene) {}
    /// Index into Scene::materials for the glTF material (-1: glTF's default material). Throws Error.
    int sceneMaterial(int gltfMaterial);
    TextureUse textureUse(int gltfMaterial) const;

 private:
    Material convert(int gltfMaterial);
    int sceneTexture(int gltfTexture, const std::string& who);
    int decode(int image, const std::string& who);

    Document& document_;
    Scene& scene_;
    std::map<int, int> materials_;  ///< glTF index -> scene index
    std::map<int, int> images_;     ///< glTF image index -> scene texture index
    std::size_t texturePixels_ = 0;
};

}  // namespace penumbra::gltf
