// Baked values on disk: a scene as .glb with them as a vertex attribute, and a bake that is not finished yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "common/scene/scene.h"

namespace penumbra {

/// Writes geometry, materials, cameras and lights of `scene`, and `values` (one per vertex) as the vertex
/// attributes _AMBIENT_VISIBILITY (scalar) and _AMBIENT_BENT (vec3, not normalised) in float. Textures are
/// not written. Throws Error if the file cannot be written.
void saveAmbient(const Scene& scene, std::span<const AmbientValue> values, const std::filesystem::path& file);

/// The values of a scene that was loaded from such a file: one per vertex, or nothing if it has none.
std::optional<std::vector<AmbientValue>> loadedAmbient(const Scene& scene);

/// The finished part of a bake: `payload` are the results of the first `done` pieces of work.
struct PartialBake {
    std::uint64_t done = 0;
    std::string payload;
};

/// Written beside, then renamed: a kill at any moment leaves the old file or the new one. `key`: a hash of
/// all that the results depend on. Throws Error if the file cannot be written.
void savePartialBake(const std::filesystem::path& file, const std::string& key, std::uint64_t done,
                     std::string_view payload);

/// What `savePartialBake` wrote under the same key; nothing if there is no file, it is damaged, or the key is
/// another: then the bake begins anew.
std::optional<PartialBake> loadPartialBake(const std::filesystem::path& file, const std::string& key);

}  // namespace penumbra
