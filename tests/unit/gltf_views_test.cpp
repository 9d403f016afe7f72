// The glTF loader: materials, textures, cameras, lights, and what it adds by itself.
#include <gtest/gtest.h>

#include "common/error.h"
#include "common/scene/gltf_loader.h"
#include "tests/unit/gltf_builder.h"
#include "tests/unit/scene_checks.h"

namespace penumbra {
namespace {

Scene load(const GltfBuilder& builder) {
    Scene scene = loadGltfFromMemory(builder.glb(), "test.glb");
    checkScene(scene);
    return scene;
}

TEST(GltfMaterials, MetallicRoughnessBecomesBlinnPhong) {
    const Json dielectric = {
        {"name", "clay"},
        {"doubleSided", true},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}}};
    const Material clay = load(squareScene({}, dielectric)).materials.at(0);
    EXPECT_EQ(clay.name, "clay");
    EXPECT_EQ(clay.diffuse, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(clay.specular, glm::vec3(0.04f));
    EXPECT_FLOAT_EQ(clay.shininess, 30.0f);  // 2 / 0.5^4 - 2
    EXPECT_TRUE(clay.doubleSided);
    EXPECT_EQ(clay.emission, glm::vec3(0.0f));

    const Json metal = {
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {1, 0.5, 0.25, 1}}, {"metallicFactor", 1}, {"roughnessFactor", 0}}}};
    const Material gold = load(squareScene({}, metal)).materials.at(0);
    EXPECT_EQ(gold.diffuse, glm::vec3(0.0f));
    EXPECT_EQ(gold.specular, glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_FLOAT_EQ(gold.shininess, 10000.0f);
}

TEST(GltfMaterials, MetalOnlyWhereTheFileSaysSo) {
    const Material material = load(squareScene({}, Json{{"name", "bare"}})).materials.at(0);
    EXPECT_EQ(material.diffuse, glm::vec3(1.0f));
    EXPECT_EQ(load(squareScene()).materials.at(0).diffuse, Material().diffuse);
}

TEST(GltfMaterials, AlphaIsIgnoredWithANote) {
    EXPECT_TRUE(hasNote(load(squareScene({}, Json{{"alphaMode", "BLEND"}})), "alpha is ignored"));
}

GltfBuilder texturedSquare(const Json& image, const Json& textureInfo) {
    GltfBuilder builder =
        squareScene({}, Json{{"pbrMetallicRoughness", {{"baseColorTexture", textureInfo}}}});
    builder.push("images", image);
    builder.push("textures", {{"source", 0}});
    builder.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        builder.addFloats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    return builder;
}

void expectTinyPng(const Scene& scene) {
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials.at(0).diffuseTexture, 0);
    const Texture& texture = scene.textures[0];
    EXPECT_EQ(texture.width, 2);
    EXPECT_EQ(texture.height, 1);
    EXPECT_EQ(texture.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 128, 255, 255}));
}

TEST(GltfTextures, FromABufferViewAndFromADataUri) {
    GltfBuilder inView = texturedSquare({{"bufferView", 3}, {"mimeType", "image/png"}}, {{"index", 0}});
    ASSERT_EQ(inView.addView(tinyPng), 3);
    expectTinyPng(load(inView));
    expectTinyPng(
        load(texturedSquare({{"uri", "data:image/png;base64," + base64(tinyPng)}}, {{"index", 0}})));
}

TEST(GltfTextures, OnlyUsedImagesAreFetched) {
    GltfBuilder builder =
        texturedSquare({{"uri", "data:image/png;base64," + base64(tinyPng)}}, {{"index", 0}});
    builder.push("images", {{"uri", "nowhere.png"}});
    expectTinyPng(load(builder));
}

TEST(GltfTextures, TheTextureTransformMovesTheCoordinates) {
    const Json transform = {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"rotation", 1.5707963267948966}};
    const Scene scene =
        load(texturedSquare({{"uri", "data:image/png;base64," + base64(tinyPng)}},
                            {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}));
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const glm::vec2 uv(scene.positions[i].x, 1.0f - scene.positions[i].y);  // of the file
        // KHR_texture_transform: translation * rotation (counter-clockwise, v down) * scale.
        const glm::vec2 expected(0.5f + 4.0f * uv.y, 0.25f - 2.0f * uv.x);
        EXPECT_NEAR(glm::distance(scene.uvs[i], expected), 0.0f, 1e-6f);
    }
}

TEST(GltfCameras, PerspectiveAndOrthographic) {
    GltfBuilder builder = squareScene();
    builder.push("cameras", {{"type", "perspective"},
                             {"name", "eye"},
                             {"perspective", {{"yfov", 0.5}, {"znear", 0.1}, {"zfar", 50}}}});
    builder.push("cameras", {{"type", "orthographic"},
                             {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 1}, {"zfar", 9}}}});
    // Looking along -X: turned by 90 degrees about Y; a scale must not matter.
    const double h = std::sqrt(0.5);
    builder.addNode(
        {{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}, {"scale", {2, 3, 4}}});
    builder.addNode({{"camera", 1}});
    const Scene scene = load(builder);
    ASSERT_EQ(scene.cameras.size(), 2u);
    const Camera &eye = scene.cameras[0], &map = scene.cameras[1];
    EXPECT_EQ(eye.name, "eye");
    EXPECT_EQ(eye.position + scene.origin, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(glm::distance(eye.forward, glm::dvec3(-1, 0, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(eye.up, glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    EXPECT_EQ(eye.verticalFov, 0.5);
    EXPECT_EQ(eye.far, 50.0);
    EXPECT_TRUE(map.orthographic);
    EXPECT_EQ(map.height, 4.0);
    EXPECT_EQ(map.near, 1.0);
    EXPECT_FALSE(hasNote(scene, "no camera"));
}

TEST(GltfCameras, AnInfiniteFarPlaneIsPutBehindTheScene) {
    GltfBuilder builder = squareScene();
    builder.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
    builder.addNode({{"camera", 0}, {"translation", {0, 0, 8}}});
    const double far = load(builder).cameras[0].far;
    EXPECT_GT(far, 8.0);
    EXPECT_LT(far, 10.0);
}

TEST(GltfCameras, NoCameraGivesAViewOfEverything) {
    const Scene scene = load(squareScene({{"translation", {30, 0, 0}}}));
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(hasNote(scene, "no camera"));
    const Camera& camera = scene.cameras[0];
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 d = scene.bounds.corner(i) - camera.position;
        const double depth = glm::dot(d, camera.forward);
        EXPECT_GT(depth, camera.near);
        EXPECT_LT(depth, camera.far);
        const double tangent = glm::length(d - depth * camera.forward) / depth;
        EXPECT_LT(tangent, std::tan(0.5 * camera.verticalFov));
    }
}

GltfBuilder litSquare(const Json& light, const Json& node = Json::object()) {
    GltfBuilder builder = squareScene();
    builder.root["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
    Json withLight = node;
    withLight["extensions"]["KHR_lights_punctual"]["light"] = 0;
    builder.addNode(withLight);
    return builder;
}

TEST(GltfLights, PunctualLights) {
    const Scene point = load(litSquare({{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 8}},
                                       {{"translation", {0, 2, 0}}, {"scale", {9, 9, 9}}}));
    ASSERT_EQ(point.lights.size(), 1u);
    EXPECT_EQ(point.lights[0].type, LightType::point);
    EXPECT_EQ(point.lights[0].emission, glm::dvec3(8, 4, 0));
    EXPECT_EQ(point.lights[0].position + point.origin, glm::dvec3(0, 2, 0));

    const Scene spot = load(litSquare(
        {{"type", "spot"}, {"intensity", 2}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.3}}}}));
    EXPECT_EQ(spot.lights[0].type, LightType::spot);
    EXPECT_EQ(spot.lights[0].direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(spot.lights[0].innerCone, 0.1);
    EXPECT_EQ(spot.lights[0].outerCone, 0.3);
    EXPECT_EQ(spot.lights[0].emission, glm::dvec3(2.0));

    const double h = std::sqrt(0.5);
    const Scene sun = load(litSquare({{"type", "directional"}}, {{"rotation", {-h, 0, 0, h}}}));
    EXPECT_EQ(sun.lights[0].type, LightType::directional);
    EXPECT_NEAR(glm::distance(sun.lights[0].direction, glm::dvec3(0, -1, 0)), 0.0, 1e-12);
    EXPECT_EQ(sun.lights[0].emission, glm::dvec3(1.0));
    EXPECT_FALSE(hasNote(sun, "sun was added"));
}

TEST(GltfLights, ConesAreBroughtIntoOrderWithANote) {
    for (const auto& [inner, outer] : {std::pair(0.5, 0.3), std::pair(0.3, 0.3), std::pair(2.0, -3.0)}) {
        const Scene scene = load(
            litSquare({{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}));
        EXPECT_GE(scene.lights[0].innerCone, 0.0);
        EXPECT_LT(scene.lights[0].innerCone, scene.lights[0].outerCone);
        EXPECT_TRUE(hasNote(scene, "cone angles brought into"));
    }
}

TEST(GltfLights, ABlackLightIsLeftOutWithANote) {
    const Scene scene = load(litSquare({{"type", "point"}, {"name", "lamp"}, {"intensity", 0}}));
    EXPECT_TRUE(hasNote(scene, "light lamp is black"));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::directional) << "the sun";
}

TEST(GltfLights, NoLightGivesASun) {
    const Scene scene = load(squareScene());
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::directional);
    EXPECT_TRUE(hasNote(scene, "no light: a sun was added"));
}

const Json glowing = {{"emissiveFactor", {1, 0.5, 0.25}},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}}};

TEST(GltfLights, AFlatEmissiveMeshIsAnAreaLight) {
    const Scene scene = load(squareScene({{"translation", {0, 3, 0}}, {"scale", {2, 1, 1}}}, glowing));
    ASSERT_EQ(scene.lights.size(), 1u);
    const Light& light = scene.lights[0];
    EXPECT_EQ(light.type, LightType::area);
    EXPECT_EQ(light.emission, glm::dvec3(10, 5, 2.5));
    EXPECT_EQ(light.part, 0);
    EXPECT_DOUBLE_EQ(light.area, 2.0);
    EXPECT_NEAR(glm::distance(light.position + scene.origin, glm::dvec3(1, 3.5, 0)), 0.0, 1e-12);
    EXPECT_EQ(light.direction, glm::dvec3(0, 0, 1)) << "the front";
    ASSERT_EQ(light.polygons.size(), 1u) << "two triangles are one rectangle";
    EXPECT_EQ(light.polygons[0].size(), 4u);
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(10, 5, 2.5));
}

TEST(GltfLights, AnEmissiveMeshThatIsNotFlatOnlyGlows) {
    GltfBuilder builder = squareScene({}, glowing);
    builder.root["accessors"][0] =
        builder.root["accessors"][builder.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0}, "VEC3")];
    const Scene scene = load(builder);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::directional) << "the sun";
    EXPECT_TRUE(hasNote(scene, "glows but is not flat"));
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(10, 5, 2.5));
}

TEST(GltfLights, FacesThatLookBothWaysAreNoLight) {
    GltfBuilder builder = squareScene({}, glowing);
    // As much back as front, and more front than back: the first has no mean normal, the second has one.
    for (const auto& order :
         std::vector<std::vector<std::uint16_t>>{{0, 1, 2, 0, 3, 2}, {0, 1, 2, 0, 2, 3, 0, 3, 1}}) {
        builder.root["meshes"][0]["primitives"][0]["indices"] = builder.addIndices(order);
        EXPECT_TRUE(hasNote(load(builder), "glows but is not flat"));
    }
}

TEST(GltfExtensions, ARequiredOneThatIsMissingIsNamed) {
    GltfBuilder builder = squareScene();
    builder.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    try {
        loadGltfFromMemory(builder.glb(), "test.glb");
        FAIL() << "loaded";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("KHR_draco_mesh_compression"), std::string::npos);
    }
    builder.root.erase("extensionsRequired");
    builder.root["extensionsUsed"] = {"EXT_wonder"};
    EXPECT_TRUE(hasNote(load(builder), "EXT_wonder is ignored"));
}

}  // namespace
}  // namespace penumbra
