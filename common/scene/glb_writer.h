// A Scene as binary glTF 2.0, for what was baked into its vertices.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "common/scene/scene.h"

namespace penumbra {

/// The bytes of a .glb with the scene's geometry, materials, cameras and lights, and `ambient`, one per
/// position, as the vertex attributes _AMBIENT_BENT and _AMBIENT_VISIBILITY (glTF 2.0, 3.7.2.1: names of
/// one's own begin with an underscore). Of a scene that came from a file, loadGltf gives the same floats
/// back. Textures are not written: those materials keep their colour.
std::string glbOf(const Scene& scene, std::span<const glm::vec4> ambient);

}  // namespace penumbra
