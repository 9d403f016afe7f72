// The glTF loader on well-formed files: geometry, node trees, and the origin.
#include "common/scene/gltf_loader.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "common/error.h"
#include "tests/unit/gltf_builder.h"
#include "tests/unit/scene_checks.h"
#include "tests/unit/temporary_folder.h"

namespace penumbra {
namespace {

Scene load(const GltfBuilder& builder) {
    Scene scene = loadGltfFromMemory(builder.glb(), "test.glb");
    checkScene(scene);
    return scene;
}

using Corner = std::array<float, 3>;
using Corners = std::array<Corner, 3>;
using TriangleSet = std::multiset<Corners>;

Corners triangle(const Corner& a, const Corner& b, const Corner& c) {
    return {a, b, c};
}

/// The triangles as a set of corner triples in file space, each starting at its least corner: winding kept,
/// order not.
TriangleSet trianglesOf(const Scene& scene) {
    TriangleSet set;
    for (std::size_t t = 0; t < scene.triangleCount(); ++t) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p =
                glm::vec3(glm::dvec3(scene.positions[scene.indices[3 * t + k]]) + scene.origin);
            corners[k] = {p.x, p.y, p.z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        set.insert(corners);
    }
    return set;
}

const TriangleSet squareTriangles = {triangle({0, 0, 0}, {1, 0, 0}, {1, 1, 0}),
                                     triangle({0, 0, 0}, {1, 1, 0}, {0, 1, 0})};

glm::vec3 windingNormal(const Scene& scene, std::size_t t) {
    const auto p = [&](std::size_t k) { return scene.positions[scene.indices[3 * t + k]]; };
    return glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
}

template <class T>
GltfBuilder squareWithIndices() {
    GltfBuilder builder;
    const int positions = builder.addFloats(squarePositions, "VEC3");
    const int indices = builder.addIndices(std::vector<T>(squareIndices.begin(), squareIndices.end()));
    const int mesh = builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    builder.addNode({{"mesh", mesh}});
    return builder;
}

TEST(GltfGeometry, IndicesOfEveryWidthAndNone) {
    EXPECT_EQ(trianglesOf(load(squareWithIndices<std::uint8_t>())), squareTriangles);
    EXPECT_EQ(trianglesOf(load(squareWithIndices<std::uint16_t>())), squareTriangles);
    EXPECT_EQ(trianglesOf(load(squareWithIndices<std::uint32_t>())), squareTriangles);
    GltfBuilder plain;
    const int positions = plain.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    plain.addNode({{"mesh", plain.addMesh({{"attributes", {{"POSITION", positions}}}})}});
    EXPECT_EQ(trianglesOf(load(plain)), squareTriangles);
}

TEST(GltfGeometry, StripAndFanKeepTheFront) {
    for (const auto& [mode, order] : std::vector<std::pair<int, std::vector<std::uint16_t>>>{
             {5, {0, 1, 3, 2}}, {6, {0, 1, 2, 3}}, {5, {0, 0, 1, 3, 2, 2}}}) {
        GltfBuilder builder;
        const int positions = builder.addFloats(squarePositions, "VEC3");
        const int indices = builder.addIndices(order);
        builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}}},
                                                   {"indices", indices},
                                                   {"mode", mode}})}});
        const Scene scene = load(builder);
        ASSERT_EQ(scene.triangleCount(), 2u) << "mode " << mode;
        // The strip that starts with a doubled vertex has its parity, and so its winding, turned round:
        // glTF 2.0, 3.7.2.1.
        const float front = order.size() == 6 ? -1.0f : 1.0f;
        for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(windingNormal(scene, t).z, front) << "mode " << mode;
    }
}

TEST(GltfGeometry, PointsAndLinesAreSkippedWithANote) {
    GltfBuilder builder = squareScene();
    builder.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    const Scene scene = load(builder);
    EXPECT_EQ(trianglesOf(scene), squareTriangles);
    EXPECT_TRUE(hasNote(scene, "points and lines are skipped"));
}

TEST(GltfGeometry, InterleavedAttributes) {
    GltfBuilder builder;
    std::vector<float> vertices;
    for (std::size_t i = 0; i < 4; ++i) {
        vertices.insert(vertices.end(), &squarePositions[3 * i], &squarePositions[3 * i] + 3);
        vertices.insert(vertices.end(), {0.0f, 0.6f, 0.8f});                                    // normal
        vertices.insert(vertices.end(), {squarePositions[3 * i], squarePositions[3 * i + 1]});  // uv
    }
    const int view = builder.addView(vertices, 32);
    Json attributes;
    attributes["POSITION"] = builder.addAccessor(view, float32, "VEC3", 4, 0);
    attributes["NORMAL"] = builder.addAccessor(view, float32, "VEC3", 4, 12);
    attributes["TEXCOORD_0"] = builder.addAccessor(view, float32, "VEC2", 4, 24);
    const int indices = builder.addIndices(squareIndices);
    builder.addNode({{"mesh", builder.addMesh({{"attributes", attributes}, {"indices", indices}})}});
    const Scene scene = load(builder);
    EXPECT_EQ(trianglesOf(scene), squareTriangles);
    ASSERT_EQ(scene.positions.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(scene.normals[i].y, 0.6f, 1e-7f);
        EXPECT_EQ(scene.uvs[i], glm::vec2(glm::dvec2(scene.positions[i]) + glm::dvec2(scene.origin)));
    }
}

TEST(GltfGeometry, WhatBelongsToACornerStaysWithIt) {
    // A grid whose triangles come in no order, and some vertices that nobody uses: all are numbered anew.
    constexpr int n = 16;
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint16_t> indices;
    for (int i = 0; i < (n + 1) * (n + 1); ++i) {
        const int column = i % (n + 1), row = i / (n + 1);
        const float x = float(column), y = float(row);
        const glm::vec3 normal = glm::normalize(glm::vec3(x, y, 1));
        positions.insert(positions.end(), {x, y, 0});
        normals.insert(normals.end(), {normal.x, normal.y, normal.z});
        uvs.insert(uvs.end(), {x, y});
    }
    for (int k = 0; k < n * n - 9; ++k) {
        const int square = k * 101 % (n * n), a = square / n * (n + 1) + square % n;
        for (const int corner : {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1})
            indices.push_back(std::uint16_t(corner));
    }
    GltfBuilder builder;
    const Json attributes{{"POSITION", builder.addFloats(positions, "VEC3")},
                          {"NORMAL", builder.addFloats(normals, "VEC3")},
                          {"TEXCOORD_0", builder.addFloats(uvs, "VEC2")}};
    const int accessor = builder.addIndices(indices);
    builder.addNode({{"mesh", builder.addMesh({{"attributes", attributes}, {"indices", accessor}})}});
    const Scene scene = load(builder);
    EXPECT_EQ(scene.triangleCount(), indices.size() / 3);
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const glm::vec3 p(glm::dvec3(scene.positions[i]) + scene.origin);
        EXPECT_EQ(scene.uvs[i], glm::vec2(p));
        EXPECT_NEAR(glm::distance(scene.normals[i], glm::normalize(glm::vec3(p.x, p.y, 1))), 0.0f, 1e-6f);
    }
}

TEST(GltfGeometry, SparseAccessorReplacesSomeElements) {
    GltfBuilder builder = squareScene();
    const int indices = builder.addView(std::vector<std::uint16_t>{1, 2});
    const int values = builder.addView(std::vector<float>{5, 0, 0, 5, 7, 0});
    const Json sparse = {{"count", 2},
                         {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                         {"values", {{"bufferView", values}}}};
    builder.root["accessors"][0]["sparse"] = sparse;
    const TriangleSet expected = {triangle({0, 0, 0}, {5, 0, 0}, {5, 7, 0}),
                                  triangle({0, 0, 0}, {5, 7, 0}, {0, 1, 0})};
    EXPECT_EQ(trianglesOf(load(builder)), expected);

    // Without a buffer view the other elements are zero; the square is then one triangle (0,0,0) (5,0,0)
    // (5,7,0) and one without extent.
    builder.root["accessors"][0].erase("bufferView");
    builder.root["accessors"][0].erase("byteOffset");
    const TriangleSet one = {triangle({0, 0, 0}, {5, 0, 0}, {5, 7, 0})};
    EXPECT_EQ(trianglesOf(load(builder)), one);
}

TEST(GltfGeometry, NormalizedTextureCoordinates) {
    for (const auto type : {uint8, uint16}) {
        GltfBuilder builder = squareScene();
        const int view =
            type == uint8
                ? builder.addView(
                      std::vector<std::uint8_t>{0, 51, 0, 0, 255, 51, 0, 0, 255, 255, 0, 0, 0, 255, 0, 0}, 4)
                : builder.addView(std::vector<std::uint16_t>{0, 13107, 65535, 13107, 65535, 65535, 0, 65535});
        const int accessor = builder.addAccessor(view, type, "VEC2", 4);
        builder.root["accessors"][accessor]["normalized"] = true;
        builder.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = accessor;
        const Scene scene = load(builder);
        for (std::size_t i = 0; i < scene.positions.size(); ++i) {
            const glm::dvec3 p = glm::dvec3(scene.positions[i]) + scene.origin;
            EXPECT_NEAR(scene.uvs[i].x, p.x, 1e-6);
            EXPECT_NEAR(scene.uvs[i].y, p.y > 0.5 ? 1.0 : 0.2, 1e-6);
        }
        builder.root["accessors"][accessor]["normalized"] = false;
        EXPECT_THROW(loadGltfFromMemory(builder.glb(), "test.glb"), Error) << "integers must be normalized";
    }
}

TEST(GltfGeometry, QuantizedPositionsOnlyWithTheirExtension) {
    GltfBuilder builder = squareScene({{"scale", {2, 2, 2}}});
    const int view = builder.addView(
        std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 32767, 32767, 0, 0, 0, 32767, 0, 0}, 8);
    const int accessor = builder.addAccessor(view, int16, "VEC3", 4);
    builder.root["accessors"][accessor]["normalized"] = true;
    builder.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
    EXPECT_THROW(loadGltfFromMemory(builder.glb(), "test.glb"), Error);
    builder.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    builder.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(load(builder).bounds.size(), glm::dvec3(2, 2, 0));
}

TEST(GltfGeometry, MissingNormalsAreFlatAndUnshared) {
    GltfBuilder builder;
    // Two triangles over one edge, folded by 90 degrees.
    const int positions = builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    const int indices = builder.addIndices(std::vector<std::uint8_t>{0, 1, 2, 1, 0, 3});
    builder.addNode(
        {{"mesh", builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
    const Scene scene = load(builder);
    ASSERT_EQ(scene.positions.size(), 6u);
    for (std::size_t t = 0; t < 2; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(scene.normals[scene.indices[3 * t + k]], windingNormal(scene, t));
        }
    }
}

TEST(GltfGeometry, NormalsWithoutDirectionAreReplaced) {
    GltfBuilder builder = squareScene();
    const float nan = std::nanf("");
    const int normals = builder.addFloats({0, 0, 0, nan, 0, 1, INFINITY, 0, 0, 0, 0, 1e-30f}, "VEC3");
    builder.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    const Scene scene = load(builder);
    for (const glm::vec3& n : scene.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
    EXPECT_TRUE(hasNote(scene, "3 normals had no direction"));
}

TEST(GltfGeometry, ExternalBufferByPercentEncodedName) {
    const TemporaryFolder folder;
    const GltfBuilder builder = squareScene();
    writeBytes(folder / "my buffer.bin", builder.binary);
    writeBytes(folder / "scene.gltf", builder.gltf("my%20buffer.bin"));
    const Scene scene = loadGltf(folder / "scene.gltf");
    EXPECT_EQ(trianglesOf(scene), squareTriangles);
    EXPECT_EQ(scene.name, "scene");
}

TEST(GltfGeometry, EmbeddedBufferLongerThanItsByteLength) {
    GltfBuilder builder = squareScene();
    FileBytes longer = builder.binary;
    while (longer.size() % 3 != 0) longer.push_back(0);
    longer.insert(longer.end(), {0xfb, 0xef, 0xbe, 0xff, 0xff, 0xff});  // "++++////"
    const std::string uri = "data:application/octet-stream;base64," + base64(longer);
    ASSERT_NE(uri.find("++++////"), std::string::npos);
    EXPECT_EQ(trianglesOf(loadGltfFromMemory(builder.gltf(uri), "test.gltf")), squareTriangles);
}

TEST(GltfNodes, MatrixAndTrsAreTheSame) {
    // Rotation by 90 degrees about Z, scale (2,3,4), translation (5,6,7).
    const double h = std::sqrt(0.5);
    const GltfBuilder trs =
        squareScene({{"translation", {5, 6, 7}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 3, 4}}});
    const GltfBuilder matrix = squareScene({{"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}});
    const Scene a = load(trs), b = load(matrix);
    ASSERT_EQ(a.positions.size(), b.positions.size());
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        EXPECT_NEAR(glm::distance(a.positions[i], b.positions[i]), 0.0f, 1e-6f);
    }
    const Aabb& box = b.bounds;
    EXPECT_EQ(box.lower + b.origin, glm::dvec3(2, 6, 7));
    EXPECT_EQ(box.upper + b.origin, glm::dvec3(5, 8, 7));
}

TEST(GltfNodes, MirroredTransformsKeepFrontAndNormalTogether) {
    GltfBuilder builder = squareScene({{"scale", {-1, 1, 1}}});
    const int normals = builder.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    builder.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
    const Scene scene = load(builder);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(windingNormal(scene, t), glm::vec3(0, 0, 1));
    for (const glm::vec3& n : scene.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST(GltfNodes, NormalsOfASlantedStretchStayPerpendicular) {
    // Plane through the X axis at 45 degrees, stretched by 3 along Y: its normal turns the other way than its
    // points.
    GltfBuilder builder;
    const float s = std::sqrt(0.5f);
    const int positions = builder.addFloats({0, 0, 0, 1, 0, 0, 0, s, s}, "VEC3");
    const int normals = builder.addFloats({0, -s, s, 0, -s, s, 0, -s, s}, "VEC3");
    const int mesh = builder.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    builder.addNode({{"mesh", mesh}, {"scale", {1, 3, 1}}});
    const Scene scene = load(builder);
    for (const glm::vec3& n : scene.normals) EXPECT_NEAR(glm::dot(n, windingNormal(scene, 0)), 1.0f, 1e-6f);
}

TEST(GltfNodes, TransformsMultiplyDownTheTree) {
    GltfBuilder builder = squareScene();
    builder.root["scenes"][0]["nodes"] = Json::array();
    const int middle = builder.addInnerNode({{"children", {0}}, {"scale", {2, 2, 2}}});
    builder.addNode({{"children", {middle}}, {"translation", {10, 0, 0}}});
    const Scene scene = load(builder);
    EXPECT_EQ(scene.bounds.lower + scene.origin, glm::dvec3(10, 0, 0));
    EXPECT_EQ(scene.bounds.upper + scene.origin, glm::dvec3(12, 2, 0));
}

TEST(GltfNodes, TheDefaultSceneCounts) {
    GltfBuilder builder = squareScene();
    builder.addInnerNode({{"mesh", 0}, {"translation", {0, 0, 9}}});
    builder.root["scenes"].push_back({{"nodes", {1}}});
    builder.root["scene"] = 1;
    EXPECT_EQ(load(builder).bounds.lower.z + load(builder).origin.z, 9.0);
    builder.root.erase("scene");
    EXPECT_EQ(trianglesOf(load(builder)), squareTriangles) << "without a default, the first";
    builder.root.erase("scenes");
    EXPECT_EQ(load(builder).triangleCount(), 4u) << "without scenes, all roots";
}

/// Spheres at generic places under rotated nodes, seen from a generic place.
GltfBuilder genericScene(const glm::dvec3& offset, bool ownNode) {
    GltfBuilder builder;
    std::vector<float> positions;
    for (int i = 0; i < 3000; ++i) {
        for (int k = 0; k < 3; ++k) positions.push_back(float(std::sin(1.7 * i + 2.1 * k + 0.3 * i * k)));
    }
    const int accessor = builder.addFloats(positions, "VEC3");
    const int mesh = builder.addMesh({{"attributes", {{"POSITION", accessor}}}});
    builder.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    const glm::dvec3 shift = ownNode ? glm::dvec3(0.0) : offset;
    Json children = Json::array();
    for (int i = 0; i < 3; ++i) {
        const double x = shift.x + 1.3 * i, y = shift.y + 0.1, z = shift.z - 0.77 * i;
        children.push_back(builder.addInnerNode({{"mesh", mesh},
                                                 {"translation", {x, y, z}},
                                                 {"rotation", {0.1, 0.2 * i, 0.3, 0.9}},
                                                 {"scale", {1, 0.3, 2}}}));
    }
    children.push_back(builder.addInnerNode(
        {{"camera", 0}, {"translation", {shift.x + 0.123, shift.y + 1.61, shift.z + 4.567}}}));
    const glm::dvec3 root = ownNode ? offset : glm::dvec3(0.0);
    builder.addNode({{"children", children}, {"translation", {root.x, root.y, root.z}}});
    return builder;
}

TEST(GltfOrigin, ASceneAMillionMetresAwayHasTheSameFloats) {
    const glm::dvec3 away(1e6);
    const Scene home = load(genericScene({}, true)), moved = load(genericScene(away, true));
    EXPECT_EQ(moved.origin - home.origin, away);
    EXPECT_EQ(moved.positions, home.positions) << "moved by a node of its own: bit for bit";
    EXPECT_EQ(moved.normals, home.normals);
    EXPECT_EQ(moved.indices, home.indices);
    EXPECT_EQ(moved.cameras[0].position, home.cameras[0].position);

    // Added to every translation, the file's own numbers are rounded to 1.2e-10 m: a float comes out another
    // one only if it was that close to a rounding boundary.
    const Scene rewritten = load(genericScene(away, false));
    ASSERT_EQ(rewritten.positions.size(), home.positions.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < home.positions.size(); ++i) {
        if (rewritten.positions[i] == home.positions[i]) continue;
        ++different;
        EXPECT_LT(glm::distance(rewritten.positions[i], home.positions[i]), 1e-6f);
    }
    EXPECT_LT(different, home.positions.size() / 20);
}

TEST(GltfOrigin, AnOrdinarySceneKeepsTheNumbersOfItsFile) {
    EXPECT_EQ(load(genericScene({}, true)).origin, glm::dvec3(0.0));
    EXPECT_EQ(load(squareScene()).origin, glm::dvec3(0.0));
}

TEST(GltfOrigin, TransformsAreAppliedInDouble) {
    GltfBuilder builder = squareScene({{"scale", {0.1, 0.1, 0.1}}, {"translation", {-1000.03, 0, 0}}});
    const float x = 10000.3f;
    builder.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        builder.addFloats({x, 0, 0, x + 1, 0, 0, x + 1, 1, 0, x, 1, 0}, "VEC3");
    const Scene scene = load(builder);
    EXPECT_NEAR(scene.bounds.lower.x + scene.origin.x, 0.1 * double(x) - 1000.03, 1e-8);
}

TEST(GltfOrigin, AHugeSceneIsFineNearItsCamera) {
    GltfBuilder builder = squareScene({{"scale", {1e5, 1e5, 1e5}}});
    builder.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    builder.addNode({{"camera", 0}, {"translation", {1001, 2002, 3003}}});
    const glm::dvec3 camera = load(builder).cameras[0].position;
    EXPECT_LE(std::max({std::abs(camera.x), std::abs(camera.y), std::abs(camera.z)}), 64.0);
}

TEST(GltfOrigin, ATinySceneFarAwayKeepsItsPrecision) {
    const GltfBuilder builder =
        squareScene({{"scale", {1e-4, 1e-4, 1e-4}}, {"translation", {123.456, 7.89, -55.5}}});
    const Scene scene = load(builder);
    EXPECT_LT(glm::length(scene.bounds.centre()), 1e-3);
    EXPECT_NEAR(scene.bounds.size().x, 1e-4, 1e-10);
    EXPECT_NEAR(scene.bounds.lower.x + scene.origin.x, 123.456, 1e-10);
}

}  // namespace
}  // namespace penumbra
