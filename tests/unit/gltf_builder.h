// glTF files built in memory: for tests of the loader and the seeds of its fuzzer.
#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace penumbra {

using Json = nlohmann::json;
using FileBytes = std::vector<std::uint8_t>;

enum ComponentType { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

/// A glTF under construction. `root` is open: tests break it on purpose.
struct GltfBuilder {
    Json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}};
    FileBytes binary;

    /// Appends bytes (4-byte aligned) as a buffer view; returns its index.
    template <class T>
    int addView(const std::vector<T>& values, int stride = 0) {
        while (binary.size() % 4 != 0) binary.push_back(0);
        Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride > 0) view["byteStride"] = stride;
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
        binary.insert(binary.end(), bytes, bytes + values.size() * sizeof(T));
        return push("bufferViews", view);
    }
    int addAccessor(int view, ComponentType component, const std::string& type, std::size_t count,
                    std::size_t byteOffset = 0) {
        return push("accessors", {{"bufferView", view},
                                  {"byteOffset", byteOffset},
                                  {"componentType", int(component)},
                                  {"count", count},
                                  {"type", type}});
    }
    int addFloats(const std::vector<float>& values, const std::string& type) {
        const std::size_t width = type == "SCALAR" ? 1 : std::size_t(type.back() - '0');
        return addAccessor(addView(values), float32, type, values.size() / width);
    }
    template <class T>
    int addIndices(const std::vector<T>& values) {
        const ComponentType type = sizeof(T) == 1 ? uint8 : sizeof(T) == 2 ? uint16 : uint32;
        return addAccessor(addView(values), type, "SCALAR", values.size());
    }
    /// A mesh of one primitive; returns the mesh.
    int addMesh(const Json& primitive) { return push("meshes", {{"primitives", Json::array({primitive})}}); }
    /// A node of the default scene.
    int addNode(const Json& node) {
        const int index = push("nodes", node);
        root["scenes"][0]["nodes"].push_back(index);
        return index;
    }
    /// A node that is a child only.
    int addInnerNode(const Json& node) { return push("nodes", node); }
    int addMaterial(const Json& material) { return push("materials", material); }

    int push(const std::string& array, const Json& entry) {
        root[array].push_back(entry);
        return int(root[array].size()) - 1;
    }

    FileBytes glb() const {
        Json withBuffer = root;
        if (!withBuffer.contains("buffers") && !binary.empty()) {
            withBuffer["buffers"] = {{{"byteLength", binary.size()}}};
        }
        std::string json = withBuffer.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        FileBytes padded = binary;
        padded.resize((padded.size() + 3) / 4 * 4, 0);
        FileBytes file;
        const auto word = [&](std::size_t value) {
            for (int i = 0; i < 4; ++i) file.push_back(std::uint8_t(value >> 8 * i));
        };
        word(0x46546C67);
        word(2);
        word(12 + 8 + json.size() + (padded.empty() ? 0 : 8 + padded.size()));
        word(json.size());
        word(0x4E4F534A);
        file.insert(file.end(), json.begin(), json.end());
        if (padded.empty()) return file;
        word(padded.size());
        word(0x004E4942);
        file.insert(file.end(), padded.begin(), padded.end());
        return file;
    }
    /// JSON with the buffer behind `uri`; nothing is written there.
    FileBytes gltf(const std::string& uri) const {
        Json withBuffer = root;
        withBuffer["buffers"] = {{{"byteLength", binary.size()}, {"uri", uri}}};
        return bytesOfText(withBuffer.dump());
    }
    static FileBytes bytesOfText(const std::string& text) { return {text.begin(), text.end()}; }
};

inline std::string base64(const FileBytes& bytes) {
    const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

inline void writeBytes(const std::string& file, const FileBytes& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

/// The unit square in the plane z = 0, front towards +Z: corners 0 (0,0), 1 (1,0), 2 (1,1), 3 (0,1).
const std::vector<float> squarePositions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<std::uint16_t> squareIndices = {0, 1, 2, 0, 2, 3};

/// The square without normals, under a node with the given extra properties.
inline GltfBuilder squareScene(const Json& node = Json::object(), const Json& material = nullptr) {
    GltfBuilder builder;
    Json primitive;
    primitive["attributes"]["POSITION"] = builder.addFloats(squarePositions, "VEC3");
    primitive["indices"] = builder.addIndices(squareIndices);
    if (!material.is_null()) primitive["material"] = builder.addMaterial(material);
    Json withMesh = node;
    withMesh["mesh"] = builder.addMesh(primitive);
    builder.addNode(withMesh);
    return builder;
}

/// A PNG of 2 x 1 pixels, red and (0, 128, 255).
const FileBytes tinyPng = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                           0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01,
                           0x08, 0x02, 0x00, 0x00, 0x00, 0x7b, 0x40, 0xe8, 0xdd, 0x00, 0x00, 0x00,
                           0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0xf8, 0xcf, 0xc0, 0xc0,
                           0xd0, 0xf0, 0x1f, 0x00, 0x08, 0x00, 0x02, 0x7f, 0x25, 0x3e, 0xfc, 0x09,
                           0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

}  // namespace penumbra
