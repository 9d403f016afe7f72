// Writes the seed corpus of fuzz_gltf, tests/fuzz/corpus/gltf: one small file for each feature of the loader,
// so that the fuzzer starts inside them instead of having to find "KHR_lights_punctual" by chance.
//   make_gltf_seeds FOLDER
#include <cstdio>
#include <filesystem>

#include "tests/unit/gltf_builder.h"

namespace penumbra {
namespace {

GltfBuilder withViews() {
    GltfBuilder builder = squareScene({{"rotation", {0, 0.6, 0, 0.8}}}, Json{{"emissiveFactor", {1, 1, 1}}});
    builder.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    builder.push("cameras", {{"type", "orthographic"},
                             {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}});
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "point"}}};
    for (int i = 0; i < 2; ++i) {
        builder.addNode({{"camera", i}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    return builder;
}

GltfBuilder withTexture() {
    const Json transform = {{"offset", {0.5, 0.5}}, {"scale", {2, 2}}, {"rotation", 1}};
    const Json info = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    GltfBuilder builder = squareScene({}, Json{{"pbrMetallicRoughness", {{"baseColorTexture", info}}}});
    builder.push("textures", {{"source", 0}});
    builder.push("images", {{"bufferView", builder.addView(tinyPng)}});
    builder.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        builder.addFloats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    return builder;
}

GltfBuilder withSparse() {
    GltfBuilder builder = squareScene({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 1, 2, 3, 1}}});
    builder.root["meshes"][0]["primitives"][0]["mode"] = 5;
    const int indices = builder.addView(std::vector<std::uint8_t>{1, 2});
    const int values = builder.addView(std::vector<float>{5, 0, 0, 5, 7, 0});
    builder.root["accessors"][0]["sparse"] = {{"count", 2},
                                              {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                              {"values", {{"bufferView", values}}}};
    return builder;
}

GltfBuilder withQuantization() {
    GltfBuilder builder = squareScene();
    const int view =
        builder.addView(std::vector<std::int8_t>{0, 0, 0, 0, 127, 0, 0, 0, 127, 127, 0, 0, 0, 127, 0, 0}, 4);
    const int accessor = builder.addAccessor(view, int8, "VEC3", 4);
    builder.root["accessors"][accessor]["normalized"] = true;
    Json& attributes = builder.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["POSITION"] = accessor;
    attributes["NORMAL"] = accessor;
    builder.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    return builder;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
    using namespace penumbra;
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_gltf_seeds FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const GltfBuilder square = squareScene();
    writeBytes(folder / "square.glb", square.glb());
    writeBytes(folder / "square.gltf",
               square.gltf("data:application/octet-stream;base64," + base64(square.binary)));
    writeBytes(folder / "views.glb", withViews().glb());
    writeBytes(folder / "texture.glb", withTexture().glb());
    writeBytes(folder / "sparse.glb", withSparse().glb());
    writeBytes(folder / "quantized.glb", withQuantization().glb());
    return 0;
}
