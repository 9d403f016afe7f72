// libFuzzer target: whatever the bytes, loadGltfFromMemory returns a sound scene or throws Error. Any other
// exception, crash, sanitizer report or endless loop is a finding.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "common/error.h"
#include "common/scene/gltf_loader.h"

namespace {

/// What the rest of the program relies on without checking again.
bool isSound(const penumbra::Scene& scene) {
    for (const std::uint32_t index : scene.indices) {
        if (index >= scene.positions.size()) return false;
    }
    for (const glm::vec3& n : scene.normals) {
        if (!(std::abs(glm::length(n) - 1.0f) < 1e-5f)) return false;
    }
    return scene.normals.size() == scene.positions.size() && scene.uvs.size() == scene.positions.size() &&
           !scene.indices.empty() && !scene.lights.empty() && !scene.cameras.empty() &&
           !scene.materials.empty();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        if (!isSound(penumbra::loadGltfFromMemory({data, data + size}, "fuzz"))) std::abort();
    } catch (const penumbra::Error&) {
    }
    return 0;
}
