// Placed triangles into the scene's arrays: one part per primitive instance. Internal to the loader.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra::gltf {

/// A triangle list with one normal and one texture coordinate per vertex, in scene space.
struct PartMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< as given; empty: flat shading
    std::vector<glm::vec2> uvs;      ///< empty: (0, 0)
    std::vector<glm::vec4> ambient;  ///< as in Scene::ambient; empty: none
    std::vector<std::uint32_t> indices;
};

/// Appends a part: flat normals where there are none (vertices are then no longer shared, as
/// glTF 2.0, 3.7.2.1 says), triangles without extent left out, clusters made, bounds and `closed` set.
/// Nothing is appended for a mesh without triangles. Returns the number of vertices whose given normal was no
/// direction and was replaced.
std::size_t appendPart(Scene& scene, PartMesh mesh, int material, const std::string& name);

}  // namespace penumbra::gltf
