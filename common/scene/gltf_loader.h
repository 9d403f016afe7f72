// glTF 2.0 files into a Scene, through tinygltf. Everything in the file is treated as hostile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace penumbra {

/// Loads a .gltf or .glb file. Throws Error with one line (what, where, what to do) for anything that is
/// broken, unsupported or too large; never crashes and never allocates more than the file's own size
/// justifies.
Scene loadGltf(const std::filesystem::path& file);

/// The same from memory (glTF JSON or GLB, told apart by the magic); external files are refused unless
/// `baseDirectory` is given. This is what the fuzzer calls.
Scene loadGltfFromMemory(const std::vector<std::uint8_t>& bytes, const std::string& name,
                         const std::filesystem::path& baseDirectory = {});

}  // namespace penumbra
