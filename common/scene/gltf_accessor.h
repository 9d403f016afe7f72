// Numbers out of a glTF accessor, with every offset checked. Internal to the loader.
#pragma once

#include <cstdint>
#include <glm/ext/vector_float1.hpp>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/scene/gltf_document.h"

namespace penumbra::gltf {

/// Which component types an attribute may have besides float (glTF 2.0, 3.7.2.1; KHR_mesh_quantization).
enum class Integers { no, normalizedUnsigned, any };

/// The elements of accessor `index` as floats, sparse substitution and normalization done. `who` names the
/// user in messages ("mesh 2 primitive 0 POSITION"). Throws Error: no such accessor, another type, out of
/// range.
std::vector<glm::vec3> readVec3(Document& document, int index, Integers integers, const std::string& who);
std::vector<glm::vec1> readScalars(Document& document, int index, Integers integers, const std::string& who);
std::vector<glm::vec2> readVec2(Document& document, int index, Integers integers, const std::string& who);
/// Unsigned 8-, 16- or 32-bit scalars.
std::vector<std::uint32_t> readIndices(Document& document, int index, const std::string& who);
/// Number of elements, without reading them. Throws Error if there is no such accessor.
std::size_t accessorCount(const Document& document, int index, const std::string& who);

}  // namespace penumbra::gltf
