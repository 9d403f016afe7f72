#include "common/scene/find_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "common/error.h"
#include "common/text/spelling.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

bool isSceneFile(const fs::path& file) {
    return file.extension() == ".glb" || file.extension() == ".gltf";
}

}  // namespace

fs::path assetsFolder() {
    const char* folder = std::getenv("PENUMBRA_ASSETS");
    return folder != nullptr && *folder != '\0' ? folder : PENUMBRA_SOURCE_DIR "/assets";
}

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(assetsFolder(), error)) {
        if (isSceneFile(entry.path())) names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

fs::path findScene(const std::string& nameOrFile) {
    std::error_code error;
    const fs::path file = nameOrFile;
    if (fs::is_regular_file(file, error)) return file;
    if (isSceneFile(file) || nameOrFile.find('/') != std::string::npos) {
        throw UsageError(fmt::format("--scene {}: no such file", nameOrFile));
    }
    for (const char* extension : {".glb", ".gltf"}) {
        const fs::path asset = assetsFolder() / (nameOrFile + extension);
        if (fs::is_regular_file(asset, error)) return asset;
    }
    const std::vector<std::string> names = sceneNames();
    const std::string available =
        names.empty() ? fmt::format("{} holds none; set PENUMBRA_ASSETS to the folder of the scenes",
                                    assetsFolder().string())
                      : "there are " + joinNames(names);
    throw UsageError(fmt::format("--scene {}: no scene of that name; {}{}", nameOrFile, available,
                                 didYouMean(nameOrFile, names)));
}

}  // namespace penumbra
