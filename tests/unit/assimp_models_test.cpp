// Real files nobody here made: every glTF of Debian's package assimp-testmodels loads, or is refused for the
// reason in the table below.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "common/error.h"
#include "common/scene/gltf_loader.h"
#include "tests/unit/scene_checks.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

const fs::path folder = "/usr/share/assimp/models/glTF2";

const char* const onlyPointsOrLines =
    "holds no triangles: there is nothing to draw (points and lines are skipped";

/// File -> words of its refusal. Whatever is not listed must load.
const std::map<std::string, std::string> refusals = {
    {"BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", "needs the extension KHR_technique_webgl"},
    {"BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "position 0 is (-inf, -0.5, 0.5)"},
    {"IndexOutOfRange/AllIndicesOutOfRange.gltf", "index number 0 is 65535, and there are 24 vertices"},
    {"IndexOutOfRange/IndexOutOfRange.gltf", "index number 0 is 255, and there are 24 vertices"},
    {"MissingBin/BoxTextured.gltf", "BoxTextured0.bin is missing"},
    {"RecursiveNodes/RecursiveNodes.gltf", "node 0 is reached twice"},
    {"SchemaFailures/sceneWrongType.gltf", "\"scene\" is \"hello\""},
    {"TestNoRootNode/NoScene.gltf", "holds no triangles"},
    {"TestNoRootNode/SceneWithoutNodes.gltf", "holds no triangles"},
    {"draco/2CylinderEngine.gltf", "needs the extension KHR_draco_mesh_compression"},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_00.gltf", onlyPointsOrLines},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_01.gltf", onlyPointsOrLines},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_02.gltf", onlyPointsOrLines},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_03.gltf", onlyPointsOrLines},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_07.gltf", onlyPointsOrLines},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_08.gltf", onlyPointsOrLines},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_09.gltf", onlyPointsOrLines},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_10.gltf", onlyPointsOrLines},
    {"wrongTypes/badArray.gltf", "\"primitives\" is {"},
    {"wrongTypes/badExtension.gltf", "\"KHR_texture_transform\" is \"Not an object\""},
    {"wrongTypes/badNumber.gltf", "'index' property is missing in NormalTextureInfo"},
    {"wrongTypes/badObject.gltf", "\"pbrMetallicRoughness\" is [\"not an object\"]"},
    {"wrongTypes/badString.gltf", "\"name\" is 42"},
    {"wrongTypes/badUint.gltf", "\"index\" is -1"},
};

std::vector<fs::path> models() {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
        const fs::path extension = entry.path().extension();
        if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path());
    }
    return files;
}

TEST(AssimpModels, ThePackageIsThere) {
    EXPECT_GE(models().size(), 43u) << "install the Debian package assimp-testmodels";
    for (const auto& [name, reason] : refusals) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(AssimpModels, EachLoadsOrIsRefusedForAKnownReason) {
    std::size_t loaded = 0, refused = 0;
    for (const fs::path& file : models()) {
        const std::string name = fs::relative(file, folder).generic_string();
        SCOPED_TRACE(name);
        const auto refusal = refusals.find(name);
        try {
            const Scene scene = loadGltf(file);
            EXPECT_EQ(refusal, refusals.end()) << "should be refused";
            checkScene(scene);
            ++loaded;
        } catch (const Error& error) {
            const std::string message = error.what();
            ASSERT_NE(refusal, refusals.end()) << message;
            EXPECT_NE(message.find(refusal->second), std::string::npos) << message;
            EXPECT_EQ(message.rfind(file.string() + ": ", 0), 0u)
                << "the message names the file: " << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << "one line: " << message;
            ++refused;
        }
    }
    EXPECT_EQ(refused, refusals.size());
    EXPECT_GE(loaded, 19u);
}

TEST(AssimpModels, TheEngineIsReadWhole) {
    const Scene scene = loadGltf(folder / "2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
    EXPECT_EQ(scene.triangleCount(), 110336u);
    EXPECT_EQ(scene.parts.size(), 115u);
    EXPECT_FALSE(hasNote(scene, "no camera"));
}

}  // namespace
}  // namespace penumbra
