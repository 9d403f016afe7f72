// The glTF loader on broken and hostile files: each gives one line that says what is wrong. Run it with
// -DPENUMBRA_SANITIZE=ON too: a read behind a buffer does not always crash.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <functional>

#include "common/error.h"
#include "common/scene/gltf_limits.h"
#include "common/scene/gltf_loader.h"
#include "tests/unit/gltf_builder.h"
#include "tests/unit/png_chunk.h"
#include "tests/unit/scene_checks.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

/// The error for these bytes; "" if they load.
std::string errorOf(const FileBytes& bytes, const std::filesystem::path& directory = {}) {
    try {
        loadGltfFromMemory(bytes, "hostile.glb", directory);
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

void expectRefused(const FileBytes& bytes, const std::string& reason,
                   const std::filesystem::path& directory = {}) {
    const std::string message = errorOf(bytes, directory);
    EXPECT_NE(message.find(reason), std::string::npos) << "message: " << message << "\nexpected: " << reason;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(message.rfind("hostile.glb: ", 0), 0u) << message;
}

/// The good square with its JSON changed.
void expectRefused(const std::function<void(Json& root)>& change, const std::string& reason) {
    GltfBuilder builder = squareScene();
    change(builder.root);
    expectRefused(builder.glb(), reason);
}

FileBytes textBytes(const std::string& text) {
    return GltfBuilder::bytesOfText(text);
}

TEST(HostileContainer, TheSquareItselfLoads) {
    EXPECT_EQ(errorOf(squareScene().glb()), "");
}

TEST(HostileContainer, NoGltfAtAll) {
    expectRefused(FileBytes{}, "not a glTF file");
    expectRefused(textBytes("hello"), "not a glTF file");
    expectRefused(textBytes("[1,2,3]"), "the JSON is not an object");
    expectRefused(textBytes("{ \"a\": 1 }"), "asset");
    expectRefused(textBytes("{}"), "not a valid glTF");
    expectRefused(textBytes("{\"asset\":{\"version\":\"2.0\"}}"), "holds no triangles");
    expectRefused(textBytes("{\"asset\":{\"version\":\"2.0\"},\"x\":1e999}"), "not a glTF file");
    expectRefused(textBytes("{\"asset\":{\"version\":\"\xff\xfe\"}}"), "not a glTF file");
}

TEST(HostileContainer, EveryTruncationOfAGlbIsRefused) {
    const FileBytes whole = squareScene().glb();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_NE(errorOf(FileBytes(whole.begin(), whole.begin() + std::ptrdiff_t(size))), "")
            << size << " bytes";
    }
    for (std::ptrdiff_t size = 4; size < 20; ++size)
        expectRefused(FileBytes(whole.begin(), whole.begin() + size), "too short for a GLB header");
}

TEST(HostileContainer, EveryTruncationOfAGltfIsRefused) {
    const GltfBuilder builder = squareScene();
    const FileBytes whole = builder.gltf("data:application/octet-stream;base64," + base64(builder.binary));
    EXPECT_EQ(errorOf(whole), "");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_NE(errorOf(FileBytes(whole.begin(), whole.begin() + std::ptrdiff_t(size))), "")
            << size << " bytes";
    }
}

TEST(HostileContainer, EveryByteOfAGlbMayBeAnything) {
    // Loads or throws Error; the sanitizers see the rest.
    const FileBytes whole = squareScene().glb();
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const int value : {0x00, 0xff, 0x7f, int(whole[i]) ^ 0x01}) {
            FileBytes changed = whole;
            changed[i] = std::uint8_t(value);
            errorOf(changed);
        }
    }
}

TEST(HostileContainer, GlbHeaderThatLies) {
    const FileBytes good = squareScene().glb();
    const auto withWord = [&](std::size_t offset, std::uint32_t value) {
        FileBytes changed = good;
        for (std::size_t i = 0; i < 4; ++i) changed[offset + i] = std::uint8_t(value >> 8 * i);
        return changed;
    };
    expectRefused(withWord(4, 1), "GLB version 1");
    expectRefused(withWord(8, 0xffffffffu), "the GLB header says 4294967295 bytes");
    expectRefused(withWord(8, 12), "the GLB header says 12 bytes");
    expectRefused(withWord(12, 0xfffffff0u), "a GLB chunk of 4294967280 bytes");
    expectRefused(withWord(16, 0x004E4942), "the first chunk of the GLB is not JSON");
    const std::size_t jsonSize = good[12] | good[13] << 8;
    expectRefused(withWord(20 + jsonSize, 0x7ffffff0u), "a GLB chunk of 2147483632 bytes");
    expectRefused(withWord(20 + jsonSize + 4, 0x12345678), "buffer 0 should have");
}

TEST(HostileJson, DeepNestingDoesNotReachTheStack) {
    const std::string deep(200000, '[');
    expectRefused(textBytes(deep), "nested more than 64 deep");
    expectRefused(textBytes("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep + "}"),
                  "nested more than 64 deep");
    std::string objects = "{\"asset\":{\"version\":\"2.0\"},\"extras\":";
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    expectRefused(textBytes(objects), "nested more than 64 deep");
    EXPECT_EQ(errorOf(squareScene({{"name", "\"" + deep}}).glb()), "") << "brackets in a name are no nesting";
}

TEST(HostileJson, TooManyValues) {
    std::string many = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}";
    for (std::size_t i = 0; i < gltf::maxObjects; ++i) many += ",{}";
    expectRefused(textBytes(many + "]}"), "\"nodes\" has 500001 entries");
    std::string deeper = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[0";
    for (std::size_t i = 0; i < gltf::maxJsonValues; ++i) deeper += ",0";
    expectRefused(textBytes(deeper + "]}"), "more than 4000000 JSON values");
}

TEST(HostileJson, PropertiesOfTheWrongType) {
    expectRefused(
        [](Json& root) {
            root["nodes"] = {{"a", 1}};
        },
        "\"nodes\" is {\"a\":1}, and must be an array");
    expectRefused([](Json& root) { root["nodes"] = {1, 2}; }, "nodes");
    expectRefused([](Json& root) { root["nodes"][0]["mesh"] = "0"; },
                  "\"mesh\" is \"0\", and must be an index");
    expectRefused([](Json& root) { root["nodes"][0]["mesh"] = -1; }, "\"mesh\" is -1");
    expectRefused([](Json& root) { root["nodes"][0]["mesh"] = 1.5; }, "\"mesh\" is 1.5");
    expectRefused([](Json& root) { root["meshes"][0]["primitives"] = 7; }, "\"primitives\" is 7");
    expectRefused([](Json& root) { root["buffers"] = {"x"}; }, "\"buffers\" must hold objects");
    expectRefused([](Json& root) { root["images"] = {nullptr}; }, "\"images\" must hold objects");
    expectRefused([](Json& root) { root["extensionsRequired"] = {1}; },
                  "\"extensionsRequired\" must hold strings");
    expectRefused([](Json& root) { root["extensionsRequired"] = "x"; }, "needs the extension x");
    expectRefused([](Json& root) { root["meshes"][0]["primitives"][0].erase("attributes"); }, "attributes");
}

TEST(HostileReferences, IndicesOfObjectsOutOfRange) {
    const int far = 1000;
    expectRefused([&](Json& root) { root["scene"] = far; }, "the default scene is 1000, and there are 1");
    expectRefused([&](Json& root) { root["scenes"][0]["nodes"] = {far}; },
                  "refers to node 1000, and there are 1");
    expectRefused([&](Json& root) { root["nodes"][0]["children"] = {far}; }, "refers to node 1000");
    expectRefused([&](Json& root) { root["nodes"][0]["children"] = {-7}; }, "refers to node -7");
    expectRefused([&](Json& root) { root["nodes"][0]["mesh"] = far; },
                  "refers to mesh 1000, and there are 1");
    expectRefused([&](Json& root) { root["nodes"][0]["camera"] = far; },
                  "refers to camera 1000, and there are 0");
    expectRefused([&](Json& root) { root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = far; },
                  "refers to accessor 1000, and there are 2");
    expectRefused([&](Json& root) { root["meshes"][0]["primitives"][0]["indices"] = far; }, "out of bounds");
    expectRefused([&](Json& root) { root["meshes"][0]["primitives"][0]["material"] = far; },
                  "refers to material 1000, and there are 0");
    expectRefused([&](Json& root) { root["meshes"][0]["primitives"][0]["mode"] = 9; }, "mode 9 is none of");
    expectRefused([&](Json& root) { root["accessors"][0]["bufferView"] = far; }, "refers to bufferView 1000");
    expectRefused([&](Json& root) { root["bufferViews"][0]["buffer"] = far; }, "refers to buffer 1000");
    expectRefused([&](Json& root) { root["nodes"][0]["mesh"] = 4294967296; },
                  "");  // 0 after wrapping: loads, or not
    expectRefused([&](Json& root) { root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = far; },
                  "refers to light 1000, and there are 0");
}

TEST(HostileReferences, TexturesAndImagesOutOfRange) {
    const auto textured = [](const Json& texture, const Json& image) {
        GltfBuilder builder =
            squareScene({}, Json{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        if (!texture.is_null()) builder.push("textures", texture);
        if (!image.is_null()) builder.push("images", image);
        return builder.glb();
    };
    expectRefused(textured(nullptr, nullptr), "refers to texture 0, and there are 0");
    expectRefused(textured({{"source", 5}}, {{"uri", "data:,"}}), "refers to image 5, and there are 1");
    expectRefused(textured({{"source", 0}}, {{"bufferView", 77}}), "refers to bufferView 77");
    expectRefused(textured({{"source", 0}}, Json::object()), "refers to bufferView -1");
    expectRefused(textured({{"source", 0}}, {{"bufferView", 0}}), "image 0: neither a PNG nor a JPEG");
    expectRefused(textured({{"source", 0}}, {{"uri", "data:image/png;base64,////"}}),
                  "image 0: neither a PNG nor a JPEG");
    expectRefused(textured({{"source", 0}}, {{"uri", "data:image/png;base64,**"}}), "not base64");
    expectRefused(textured({{"source", 0}}, {{"uri", "data:image/png,x"}}), "only base64");
    FileBytes half(tinyPng.begin(), tinyPng.begin() + 50);
    expectRefused(textured({{"source", 0}}, {{"uri", "data:image/png;base64," + base64(half)}}), "image 0");
    const auto saying = [](std::uint32_t width, std::uint32_t height) {  // an honest checksum, and a lie
        std::string header(tinyPng.begin() + 16, tinyPng.begin() + 29);
        header.replace(0, 8, bigEndian(width) + bigEndian(height));
        const std::string chunk = pngChunk("IHDR", header);
        FileBytes png = tinyPng;
        std::copy(chunk.begin(), chunk.end(), png.begin() + 8);
        return Json{{"uri", "data:image/png;base64," + base64(png)}};
    };
    EXPECT_EQ(errorOf(textured({{"source", 0}}, saying(2, 1))), "");
    expectRefused(textured({{"source", 0}}, saying(8193, 8192)), "is more than the limit of 67108864");
    expectRefused(textured({{"source", 0}}, saying(0x7fffffff, 0x7fffffff)), "image 0");
}

TEST(HostileAccessors, CountsAndOffsetsBeyondTheBuffer) {
    for (const std::uint64_t count : {std::uint64_t(5), std::uint64_t(1) << 31, (std::uint64_t(1) << 31) - 1,
                                      std::uint64_t(1) << 32, std::uint64_t(1) << 62, ~std::uint64_t(0),
                                      // Times a stride of 12 or 2 these wrap round to next to nothing.
                                      (std::uint64_t(1) << 62) + 1, (std::uint64_t(1) << 63) + 1}) {
        expectRefused([&](Json& root) { root["accessors"][0]["count"] = count; }, "reach beyond");
        expectRefused([&](Json& root) { root["accessors"][1]["count"] = 2 + count; },
                      count > ~std::uint64_t(0) - 2 ? "" : "reach beyond");
        expectRefused([&](Json& root) { root["accessors"][0]["byteOffset"] = count; }, "reach beyond");
        expectRefused([&](Json& root) { root["bufferViews"][0]["byteOffset"] = 100 + count / 2; },
                      "reaches beyond");
        expectRefused([&](Json& root) { root["bufferViews"][0]["byteLength"] = 100 + count / 2; },
                      "reaches beyond");
    }
    expectRefused(
        [&](Json& root) {  // together they wrap round to 4
            root["bufferViews"][0]["byteOffset"] = ~std::uint64_t(0) - 3;
            root["bufferViews"][0]["byteLength"] = 8;
        },
        "reaches beyond");
    expectRefused([&](Json& root) { root["bufferViews"][0]["byteStride"] = 252; }, "reach beyond");
    expectRefused([&](Json& root) { root["bufferViews"][0]["byteStride"] = 1; }, "byteStride");
    expectRefused([&](Json& root) { root["accessors"][0]["componentType"] = 5124; }, "wrong type");
    expectRefused([&](Json& root) { root["accessors"][0]["componentType"] = 5130; }, "wrong type");
    expectRefused([&](Json& root) { root["accessors"][0]["componentType"] = 99999; }, "componentType");
    expectRefused([&](Json& root) { root["accessors"][0]["type"] = "VEC4"; }, "wrong type");
    expectRefused([&](Json& root) { root["accessors"][0]["type"] = "MAT4"; }, "wrong type");
    expectRefused([&](Json& root) { root["accessors"][1]["componentType"] = 5126; },
                  "not of unsigned integers");
}

TEST(HostileAccessors, ManyElementsWithoutBytes) {
    const auto withoutView = [](std::uint64_t count) {
        return [count](Json& root) {
            root["accessors"][0].erase("bufferView");
            root["accessors"][0]["count"] = count;
        };
    };
    expectRefused(withoutView(std::uint64_t(1) << 31), "2147483648 elements without bytes");
    expectRefused(withoutView(~std::uint64_t(0)), "elements without bytes");
    expectRefused(withoutView(4), "holds no triangles");
}

TEST(HostileAccessors, SparseOutOfRange) {
    const Json good = {{"count", 1},
                       {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                       {"values", {{"bufferView", 0}}}};
    const auto withSparse = [&](const std::function<void(Json & sparse)>& change) {
        return [&good, change](Json& root) {
            root["accessors"][0]["sparse"] = good;
            change(root["accessors"][0]["sparse"]);
        };
    };
    GltfBuilder fine = squareScene();
    fine.root["accessors"][0]["sparse"] = good;
    EXPECT_EQ(errorOf(fine.glb()), "");
    expectRefused(withSparse([](Json& s) { s["count"] = 5; }), "(sparse)");
    expectRefused(withSparse([](Json& s) { s["count"] = 4294967295u; }), "(sparse)");
    expectRefused(withSparse([](Json& s) { s["indices"]["bufferView"] = 9; }), "refers to bufferView 9");
    expectRefused(withSparse([](Json& s) { s["indices"]["byteOffset"] = 11; }), "reach beyond");
    expectRefused(withSparse([](Json& s) { s["indices"]["byteOffset"] = 3000000000u; }), "out of range");
    expectRefused(withSparse([](Json& s) { s["indices"]["componentType"] = 5126; }), "out of range");
    expectRefused(withSparse([](Json& s) { s["values"]["byteOffset"] = 40; }), "reach beyond");
    expectRefused(withSparse([](Json& s) { s["values"] = 3; }), "");
    expectRefused(
        [&](Json& root) {  // the indices are read from the positions: the float 1.0 is index 0x3f80
            root["accessors"][0]["sparse"] = good;
            root["accessors"][0]["sparse"]["indices"] = {
                {"bufferView", 0}, {"componentType", 5123}, {"byteOffset", 14}};
        },
        "index 16256 of 4 elements");
}

TEST(HostileGeometry, IndexBeyondTheVertices) {
    GltfBuilder builder = squareScene();
    builder.root["meshes"][0]["primitives"][0]["indices"] =
        builder.addIndices(std::vector<std::uint32_t>{0, 1, 4});
    expectRefused(builder.glb(), "index number 2 is 4, and there are 4 vertices");
    builder.root["meshes"][0]["primitives"][0]["indices"] =
        builder.addIndices(std::vector<std::uint32_t>{0, 1, 0xffffffffu});
    expectRefused(builder.glb(), "index number 2 is 4294967295");
}

TEST(HostileGeometry, PositionsThatAreNoPoints) {
    for (const float bad : {INFINITY, -INFINITY, std::nanf("")}) {
        GltfBuilder builder = squareScene();
        std::vector<float> positions = squarePositions;
        positions[7] = bad;
        builder.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
            builder.addFloats(positions, "VEC3");
        expectRefused(builder.glb(), "not a point in space");
    }
    GltfBuilder builder = squareScene();
    builder.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        builder.addFloats({3e38f, 0, 0, -3e38f, 0, 0, 3e38f, 3e38f, 0, 0, 1, 0}, "VEC3");
    expectRefused(builder.glb(), "more than 1e15 m away");
}

TEST(HostileGeometry, CountsOfAttributesDiffer) {
    GltfBuilder builder = squareScene();
    builder.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = builder.addFloats({0, 0, 1}, "VEC3");
    expectRefused(builder.glb(), "NORMAL: 1 values for 4 vertices");
}

TEST(HostileGeometry, TrianglesWithoutExtentAreLeftOut) {
    GltfBuilder builder = squareScene();
    builder.root["meshes"][0]["primitives"][0]["indices"] =
        builder.addIndices(std::vector<std::uint8_t>{0, 0, 1, 2, 2, 2});
    expectRefused(builder.glb(), "holds no triangles");
    builder = squareScene({{"scale", {0, 0, 0}}});
    expectRefused(builder.glb(), "holds no triangles");
    // Flattened to a line, it has extent and no area: every vertex still gets a unit normal.
    GltfBuilder flattened = squareScene({{"scale", {1, 0, 1}}});
    flattened.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        flattened.addFloats({0, 0, 0, 1, 0, 0, 2, 1, 0, 3, 1, 0}, "VEC3");
    const Scene line = loadGltfFromMemory(flattened.glb(), "line.glb");
    checkScene(line);
}

TEST(HostileGeometry, InstancingBomb) {
    // 1000 nodes of a mesh with 1000 primitives that share one accessor of 300 vertices: 100 million
    // triangles in 60 kB.
    GltfBuilder builder;
    std::vector<float> positions;
    for (int i = 0; i < 900; ++i) positions.push_back(float((i * 7919) % 1000));
    const Json primitive = {{"attributes", {{"POSITION", builder.addFloats(positions, "VEC3")}}}};
    Json primitives = Json::array();
    for (int i = 0; i < 1000; ++i) primitives.push_back(primitive);
    const int mesh = builder.push("meshes", {{"primitives", primitives}});
    for (int i = 0; i < 1000; ++i) builder.addNode({{"mesh", mesh}});
    expectRefused(builder.glb(), "more than 20 million triangles");
}

TEST(HostileGeometry, ReadingBomb) {
    // A million vertices without bytes, of which each primitive uses three: no memory, but 10^9 reads.
    GltfBuilder builder = squareScene();
    builder.root["accessors"][0].erase("bufferView");
    builder.root["accessors"][0]["count"] = gltf::maxZeroElements;
    const Json primitive = builder.root["meshes"][0]["primitives"][0];
    for (int i = 0; i < 1000; ++i) builder.root["meshes"][0]["primitives"].push_back(primitive);
    expectRefused(builder.glb(), "asks for more than 400 million vertices");
}

TEST(HostileNodes, CyclesAndSharedChildren) {
    expectRefused([](Json& root) { root["nodes"][0]["children"] = {0}; }, "node 0 is reached twice");
    expectRefused([](Json& root) { root["scenes"][0]["nodes"] = {0, 0}; }, "node 0 is reached twice");
    expectRefused(
        [](Json& root) {  // doubling at each level: 2^40 instances
            root["nodes"] = Json::array();
            for (int i = 0; i < 40; ++i) root["nodes"].push_back({{"children", {i + 1, i + 1}}});
            root["nodes"].push_back({{"mesh", 0}});
        },
        "is reached twice");
    expectRefused(
        [](Json& root) {
            root["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
            root.erase("scenes");
            root.erase("scene");
        },
        "holds no triangles");
}

TEST(HostileNodes, AHundredThousandLevelsDeep) {
    GltfBuilder builder = squareScene();
    const int depth = 100000;
    for (int i = 1; i <= depth; ++i) builder.addInnerNode({{"children", {i == 1 ? 0 : i - 1}}});
    builder.root["scenes"][0]["nodes"] = {depth};
    EXPECT_EQ(errorOf(builder.glb()), "");
}

TEST(HostileNodes, TransformsThatAreNone) {
    const auto withNode = [](const Json& node) { return squareScene(node).glb(); };
    expectRefused(withNode({{"matrix", {1, 2, 3}}}), "matrix has 3 numbers, and must have 16");
    expectRefused(withNode({{"translation", {1, 2}}}), "translation has 2 numbers");
    expectRefused(withNode({{"rotation", {1, 2}}}), "rotation has 2 numbers");
    expectRefused(withNode({{"scale", {1}}}), "scale has 1 numbers");
    expectRefused(withNode({{"rotation", {0, 0, 0, 0}}}), "its rotation is no quaternion");
    expectRefused(withNode({{"translation", {1e308, 0, 0}}, {"scale", {1e308, 1e308, 1e308}}}),
                  "hostile.glb");
    expectRefused(withNode({{"scale", {1e30, 1e30, 1e30}}}), "more than 1e15 m away");
    GltfBuilder nested = squareScene({{"scale", {1e200, 1e200, 1e200}}});
    nested.root["scenes"][0]["nodes"] = {
        nested.addInnerNode({{"children", {0}}, {"scale", {1e200, 1e200, 1e200}}})};
    expectRefused(nested.glb(), "node 0: its transform is not finite");
}

TEST(HostileViews, CamerasAndLightsThatMakeNoPicture) {
    const auto withCamera = [](const Json& camera, const Json& node = Json::object()) {
        GltfBuilder builder = squareScene();
        builder.push("cameras", camera);
        Json withIndex = node;
        withIndex["camera"] = 0;
        builder.addNode(withIndex);
        return builder.glb();
    };
    const auto perspective = [](double yfov, double near, double far) {
        return Json{{"type", "perspective"},
                    {"perspective", {{"yfov", yfov}, {"znear", near}, {"zfar", far}}}};
    };
    EXPECT_EQ(errorOf(withCamera(perspective(1, 1, 2))), "");
    expectRefused(withCamera(perspective(0, 1, 2)), "yfov is 0");
    expectRefused(withCamera(perspective(4, 1, 2)), "yfov is 4");
    expectRefused(withCamera(perspective(1, 0, 2)), "0 < znear < zfar");
    expectRefused(withCamera(perspective(1, 3, 2)), "0 < znear < zfar");
    expectRefused(withCamera(perspective(1, 1, 2), {{"scale", {0, 1, 0}}}), "whose scale is not 0");
    expectRefused(withCamera({{"type", "fisheye"}}), "Invalid camera type");
    expectRefused(withCamera({{"type", "orthographic"},
                              {"orthographic", {{"xmag", 1}, {"ymag", 0}, {"znear", 0}, {"zfar", 1}}}}),
                  "ymag is 0");
    const auto withLight = [](const Json& light) {
        GltfBuilder builder = squareScene();
        builder.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
        builder.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        return builder.glb();
    };
    expectRefused(withLight({{"type", "laser"}}), "is none of point, spot, directional");
    expectRefused(withLight({{"type", "spot"}}), "Spot light description not found");
    expectRefused(withLight(7), "type");
    EXPECT_EQ(
        errorOf(withLight({{"type", "spot"}, {"spot", {{"innerConeAngle", 2}, {"outerConeAngle", -3}}}})),
        "");
}

TEST(HostileUris, NothingOutsideTheFolderIsRead) {
    const TemporaryFolder folder;
    const GltfBuilder builder = squareScene();
    std::filesystem::create_directories(folder / "inner/sub");
    writeBytes(folder / "outside.bin", builder.binary);
    writeBytes(folder / "inner/sub/data.bin", builder.binary);
    const std::filesystem::path inner = folder / "inner";
    EXPECT_EQ(errorOf(builder.gltf("sub/data.bin"), inner), "");
    expectRefused(builder.gltf("../outside.bin"), "leaves the folder", inner);
    expectRefused(builder.gltf("%2e%2e/outside.bin"), "leaves the folder", inner);
    expectRefused(builder.gltf("sub/../../outside.bin"), "leaves the folder", inner);
    expectRefused(builder.gltf((folder / "outside.bin").string()), "is an absolute path", inner);
    expectRefused(builder.gltf("..\\outside.bin"), "backslash", inner);
    expectRefused(builder.gltf("file:///etc/passwd"), "is not a relative path", inner);
    expectRefused(builder.gltf("http://example.org/a.bin"), "is not a relative path", inner);
    expectRefused(builder.gltf("sub/data.bin%00.png"), "zero byte", inner);
    expectRefused(builder.gltf("sub"), "is missing", inner);
    expectRefused(builder.gltf("nowhere.bin"), "nowhere.bin is missing", inner);
    expectRefused(builder.gltf("sub/data.bin"), "this glTF has no folder");
    expectRefused(builder.gltf("$(touch hacked).bin"), "is missing", inner);
    std::filesystem::resize_file(folder / "inner/sub/data.bin", builder.binary.size() - 1);
    expectRefused(
        builder.gltf("sub/data.bin"),
        fmt::format("should have {} bytes and has {}", builder.binary.size(), builder.binary.size() - 1),
        inner);
    std::error_code error;
    std::filesystem::create_symlink("/dev/zero", folder / "inner/endless.bin", error);
    expectRefused(builder.gltf("endless.bin"), "is missing", inner);
}

TEST(HostileUris, OnlyOneBufferMayBeTheBinaryChunk) {
    // tinygltf would copy the chunk once per entry.
    GltfBuilder builder = squareScene();
    builder.root["buffers"] = Json::array();
    for (int i = 0; i < 1000; ++i) builder.root["buffers"].push_back({{"byteLength", builder.binary.size()}});
    expectRefused(builder.glb(), "buffer 1 has no uri");
    builder.root["buffers"] = {{{"byteLength", builder.binary.size() + 100}}};
    expectRefused(builder.glb(), "the file is truncated");
    builder.root["buffers"] = {{{"byteLength", -1}}};
    expectRefused(builder.glb(), "byteLength");
    builder.root["buffers"] = Json::array();
    expectRefused(builder.glb(), "refers to buffer 0, and there are 0");
}

TEST(HostileText, NamesNeverBreakTheLine) {
    GltfBuilder builder = squareScene({{"name", "two\nlines\x1b[31m" + std::string(5000, 'x')}});
    builder.root["nodes"][0]["mesh"] = 9;
    const std::string message = errorOf(builder.glb());
    EXPECT_NE(message.find("two?lines?[31m"), std::string::npos) << message;
    EXPECT_LT(message.size(), 300u);
}

TEST(HostileFiles, WhatIsNoFile) {
    const TemporaryFolder folder;
    EXPECT_THROW(loadGltf(folder / "missing.glb"), Error);
    try {
        loadGltf(folder.path());
        FAIL() << "a folder";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no such file"), std::string::npos) << error.what();
    }
    writeBytes(folder / "empty.glb", {});
    EXPECT_THROW(loadGltf(folder / "empty.glb"), Error);
}

}  // namespace
}  // namespace penumbra
