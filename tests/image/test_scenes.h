// The scenes that every chapter is tested on.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace penumbra {

/// A model nobody here made (Debian package assimp-testmodels).
inline const std::string thirdPartyModel =
    "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";

inline std::vector<std::string> testScenes() {
    return {"heckbert_herf", "contact", "courtyard", thirdPartyModel};
}

/// "2CylinderEngine" from a path, a scene's name as it is: for the names of tests.
inline std::string shortName(const std::string& nameOrFile) {
    const std::string name = nameOrFile.substr(nameOrFile.find_last_of('/') + 1);
    return name.substr(0, name.find('.'));
}

inline std::string sceneTestName(const testing::TestParamInfo<std::string>& scene) {
    return shortName(scene.param);
}

}  // namespace penumbra
