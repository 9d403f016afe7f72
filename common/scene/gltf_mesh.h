// One glTF primitive as a triangle list in its mesh's own space. Internal to the loader.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "common/scene/gltf_document.h"

namespace penumbra::gltf {

struct LocalMesh {
    std::vector<glm::vec3> positions;    ///< finite
    std::vector<glm::vec3> normals;      ///< as in the file, or empty
    std::vector<glm::vec2> uvs;          ///< as in the file, or empty
    std::vector<glm::vec4> ambient;      ///< as in Scene::ambient, in the mesh's own space, or empty
    std::vector<std::uint32_t> indices;  ///< 3 per triangle; every vertex is used
};

/// Triangles, strips and fans, indexed or not. Nothing, and a note, for points and lines. `texCoord`: which
/// TEXCOORD set becomes `uvs`. Throws Error.
std::optional<LocalMesh> readPrimitive(Document& document, int mesh, int primitive, int texCoord);

}  // namespace penumbra::gltf
