#include "common/scene/find_scene.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "common/error.h"
#include "tests/unit/gltf_builder.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

class FindScene : public testing::Test {
 protected:
    FindScene() {
        ::setenv("PENUMBRA_ASSETS", folder_.path().c_str(), 1);
        writeBytes(folder_ / "fence.glb", squareScene().glb());
        writeBytes(folder_ / "spheres.gltf", {});
        writeBytes(folder_ / "readme.txt", {});
    }
    ~FindScene() override { ::unsetenv("PENUMBRA_ASSETS"); }

    static std::string usageErrorOf(const std::string& name) {
        try {
            findScene(name);
            return "";
        } catch (const UsageError& error) {
            return error.what();
        }
    }
    TemporaryFolder folder_;
};

TEST_F(FindScene, ByNameAndByFile) {
    EXPECT_EQ(findScene("fence"), folder_ / "fence.glb");
    EXPECT_EQ(findScene("spheres"), folder_ / "spheres.gltf");
    EXPECT_EQ(findScene((folder_ / "fence.glb").string()), folder_ / "fence.glb");
    EXPECT_EQ(sceneNames(), (std::vector<std::string>{"fence", "spheres"}));
}

TEST_F(FindScene, AnUnknownNameListsTheScenesAndTheNearest) {
    const std::string message = usageErrorOf("spheers");
    EXPECT_NE(message.find("fence, spheres"), std::string::npos) << message;
    EXPECT_NE(message.find("did you mean spheres?"), std::string::npos) << message;
    EXPECT_NE(usageErrorOf("nowhere.glb").find("no such file"), std::string::npos);
    EXPECT_NE(usageErrorOf("some/folder").find("no such file"), std::string::npos);
    ::setenv("PENUMBRA_ASSETS", "/nonexistent", 1);
    EXPECT_NE(usageErrorOf("fence").find("/nonexistent holds none"), std::string::npos);
}

TEST_F(FindScene, WithoutTheVariableTheSourceTreeIsTaken) {
    ::unsetenv("PENUMBRA_ASSETS");
    EXPECT_EQ(assetsFolder(), std::filesystem::path(PENUMBRA_SOURCE_DIR) / "assets");
}

}  // namespace
}  // namespace penumbra
