// Which file `--scene NAME|FILE` means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra {

/// A path (anything with a slash, a .gltf or .glb ending, or the name of an existing file) is taken as it is;
/// anything else is the name of a scene in the assets folder. Throws UsageError, one line: no such file, or
/// no such scene, with the scenes there are and the nearest spelling.
std::filesystem::path findScene(const std::string& nameOrFile);

/// Names of the scenes in the assets folder, sorted.
std::vector<std::string> sceneNames();

/// $PENUMBRA_ASSETS, or the assets/ of the source tree (an absolute path compiled in).
std::filesystem::path assetsFolder();

}  // namespace penumbra
