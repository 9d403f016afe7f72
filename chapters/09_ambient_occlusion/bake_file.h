// Baked values on disk: a scene as .glb with them as a vertex attribute.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/ambient_estimate.h"
#include "common/scene/scene.h"

namespace penumbra {

/// Writes geometry, materials, cameras and lights of `scene`, and `values` (one per vertex) as the vertex
/// attributes _AMBIENT_VISIBILITY (scalar) and _AMBIENT_BENT (vec3, not normalised) in float. Textures are
/// not written. Throws Error if the file cannot be written.
void saveAmbient(const Scene& scene, std::span<const AmbientValue> values, const std::filesystem::path& file);

/// Before a bake that takes minutes: throws what saving to `file` would, as far as can be known by then, and
/// UsageError where the name does not end in .glb, by which --scene knows it again. Leaves nothing behind.
void requireSavable(const std::filesystem::path& file);

/// The values of a scene that was loaded from such a file: one per vertex, or nothing if it has none.
std::optional<std::vector<AmbientValue>> loadedAmbient(const Scene& scene);

}  // namespace penumbra
