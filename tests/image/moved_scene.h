// The same scene a million metres away.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/scene/find_scene.h"
#include "common/scene/gltf_loader.h"

namespace penumbra {

/// The .glb scene `name`, all root nodes of which became children of one more, translated by `offset` metres
/// along x, y and z.
inline Scene movedScene(const std::string& name, double offset) {
    std::ifstream file(findScene(name), std::ios::binary);
    std::vector<std::uint8_t> glb((std::istreambuf_iterator<char>(file)), {});
    // A .glb is a header of 12 bytes, then chunks: length, type, bytes. The first is the JSON text.
    std::uint32_t jsonLength = 0;
    std::memcpy(&jsonLength, glb.data() + 12, 4);
    nlohmann::json json = nlohmann::json::parse(glb.begin() + 20, glb.begin() + 20 + jsonLength);
    for (auto& scene : json.at("scenes")) {
        json["nodes"].push_back({{"children", scene.at("nodes")}, {"translation", {offset, offset, offset}}});
        scene["nodes"] = {json["nodes"].size() - 1};
    }
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::uint8_t> moved(glb.begin(), glb.begin() + 20);
    moved.insert(moved.end(), text.begin(), text.end());
    moved.insert(moved.end(), glb.begin() + 20 + jsonLength, glb.end());
    const auto store = [&moved](std::size_t at, std::size_t value) {
        const auto narrow = std::uint32_t(value);
        std::memcpy(moved.data() + at, &narrow, 4);
    };
    store(8, moved.size());
    store(12, text.size());
    return loadGltfFromMemory(moved, name + " moved");
}

}  // namespace penumbra
