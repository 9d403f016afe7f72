// Cameras and punctual lights of placed nodes. Internal to the loader.
#pragma once

#include <vector>

#include "common/scene/gltf_document.h"
#include "common/scene/gltf_nodes.h"
#include "common/scene/scene.h"

namespace penumbra::gltf {

/// Every camera of the tree. A perspective camera without zfar gets far = infinity: `finishCameras` sets it.
/// Throws Error for lengths and angles that make no picture.
void addCameras(const Document& document, const std::vector<PlacedNode>& nodes, Scene& scene);

/// Gives cameras with an infinite far plane one just behind the scene: depth has finite precision.
void finishCameras(Scene& scene);

/// KHR_lights_punctual. Numbers are taken as radiometric (W/sr, W/m^2) without conversion from photometric
/// units: pictures are exposed to their key light, so only ratios show.
void addPunctualLights(Document& document, const std::vector<PlacedNode>& nodes, Scene& scene);

}  // namespace penumbra::gltf
