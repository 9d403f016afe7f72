#include "common/scene/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "common/scene/gltf_limits.h"

namespace penumbra::gltf {
namespace {

using Json = nlohmann::json;

constexpr std::array supportedExtensions = {
    std::string_view("KHR_lights_punctual"), std::string_view("KHR_materials_emissive_strength"),
    std::string_view("KHR_texture_transform"), std::string_view("KHR_mesh_quantization")};

/// Never used here, and the usual places for large or deep data.
constexpr std::array unusedKeys = {"extras", "animations", "skins", "samplers", "min", "max"};

enum class Kind { index, size, number, text, object, array };

/// glTF uses each of these keys with one type only. tinygltf takes an optional property of the wrong type as
/// absent, and the picture would be wrong without a word.
const std::map<std::string, Kind>& keyKinds() {
    static const std::map<std::string, Kind> kinds = [] {
        const std::pair<Kind, const char*> rules[] = {
            {Kind::index,
             "scene mesh camera skin material mode index texCoord buffer bufferView componentType source "
             "light"},
            {Kind::size, "byteOffset byteLength byteStride count"},
            {Kind::number,
             "intensity range innerConeAngle outerConeAngle yfov znear zfar xmag ymag metallicFactor "
             "roughnessFactor "
             "emissiveStrength"},
            {Kind::text, "name uri type alphaMode version"},
            {Kind::object,
             "asset pbrMetallicRoughness baseColorTexture emissiveTexture attributes sparse extensions "
             "KHR_lights_punctual KHR_texture_transform KHR_materials_emissive_strength"},
            {Kind::array,
             "scenes nodes meshes accessors buffers bufferViews materials textures images cameras lights "
             "children "
             "primitives matrix translation baseColorFactor emissiveFactor color extensionsUsed "
             "extensionsRequired"}};
        std::map<std::string, Kind> map;
        for (const auto& [kind, keys] : rules) {
            std::istringstream words(keys);
            for (std::string key; words >> key;) map.emplace(key, kind);
        }
        return map;
    }();
    return kinds;
}

bool isKind(const Json& value, Kind kind) {
    switch (kind) {
        case Kind::index:  // tinygltf would wrap it round to an int
            return value.is_number_unsigned() &&
                   value.get<std::uint64_t>() <= std::uint64_t(std::numeric_limits<int>::max());
        case Kind::size:
            return value.is_number_unsigned();
        case Kind::number:
            return value.is_number();
        case Kind::text:
            return value.is_string();
        case Kind::object:
            return value.is_object();
        case Kind::array:
            return value.is_array();
    }
    return false;
}

const char* kindName(Kind kind) {
    constexpr std::array names = {"an index, 0 to 2147483647",
                                  "a whole number, 0 or more",
                                  "a number",
                                  "a string",
                                  "an object",
                                  "an array"};
    return names[std::size_t(kind)];
}

bool isSupported(const std::string& extension) {
    return std::find(supportedExtensions.begin(), supportedExtensions.end(), extension) !=
           supportedExtensions.end();
}

void dropUnusedKeys(Json& object) {
    for (const char* key : unusedKeys) object.erase(key);
}

/// A vendor's extension may use any key for anything.
void dropUnsupportedExtensions(Json& object) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return;
    for (auto it = extensions->begin(); it != extensions->end();) {
        it = isSupported(it.key()) ? std::next(it) : extensions->erase(it);
    }
}

/// Recursion is bounded by maxJsonDepth.
void pruneAndCheckTypes(Json& value, const Document& document) {
    if (!value.is_structured()) return;
    if (value.is_object()) {
        dropUnusedKeys(value);
        dropUnsupportedExtensions(value);
    }
    for (auto it = value.begin(); it != value.end(); ++it) {
        if (value.is_object()) {
            const auto rule = keyKinds().find(it.key());
            if (rule != keyKinds().end() && !isKind(*it, rule->second)) {
                document.fail(fmt::format("\"{}\" is {}, and must be {}", it.key(), printable(it->dump(), 40),
                                          kindName(rule->second)));
            }
        }
        pruneAndCheckTypes(*it, document);
    }
}

/// Counts nesting and values in the text itself, before any memory is spent on them. (The parser's callback
/// would do, but it searches the whole parent at the end of every child: quadratic in the number of nodes.)
void checkNesting(Bytes json, const Document& document) {
    int depth = 0;
    std::size_t values = 0;
    bool inString = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = char(json[i]);
        if (inString) {
            if (c == '\\') ++i;
            if (c == '"') inString = false;
            continue;
        }
        if (c == '"') inString = true;
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (c == '{' || c == '[' || c == ',') ++values;
        if (depth > maxJsonDepth) {
            document.fail(
                fmt::format("the JSON is nested more than {} deep, which no valid glTF is", maxJsonDepth));
        }
        if (values > maxJsonValues) {
            document.fail(fmt::format("more than {} JSON values: split the scene", maxJsonValues));
        }
    }
}

Json parse(Bytes json, const Document& document) {
    checkNesting(json, document);
    try {
        return Json::parse(json.begin(), json.end());
    } catch (const Json::exception& exception) {
        document.fail(fmt::format("not a glTF file: {}", exception.what()));
    }
}

void checkSizes(const Json& root, const Document& document) {
    for (auto it = root.begin(); it != root.end(); ++it) {
        if (it->size() > maxObjects) {
            document.fail(fmt::format("\"{}\" has {} entries, and at most {} are supported: split the scene",
                                      it.key(), it->size(), maxObjects));
        }
    }
}

void checkExtensions(const Json& root, Document& document) {
    for (const Json& name : root.value("extensionsRequired", Json::array())) {
        if (!name.is_string()) document.fail("\"extensionsRequired\" must hold strings");
        if (!isSupported(name.get<std::string>())) {
            document.fail(
                fmt::format("needs the extension {}, which is not supported: export the scene without it",
                            printable(name.get<std::string>(), 80)));
        }
    }
    for (const Json& name : root.value("extensionsUsed", Json::array())) {
        if (name.is_string() && !isSupported(name.get<std::string>())) {
            document.note(fmt::format("the extension {} is ignored", printable(name.get<std::string>(), 80)));
        }
    }
}

/// Takes `key` out of the root, as an array of objects.
Json takeObjects(Json& root, const char* key, const Document& document) {
    Json array = Json::array();
    if (root.contains(key)) array = std::move(root[key]);
    root.erase(key);
    for (const Json& entry : array) {
        if (!entry.is_object()) document.fail(fmt::format("\"{}\" must hold objects", key));
    }
    return array;
}

}  // namespace

PrunedJson pruneJson(Bytes json, Document& document) {
    Json root = parse(json, document);
    if (!root.is_object()) document.fail("not a glTF file: the JSON is not an object");
    checkExtensions(root,
                    document);  // first: a file that needs an extension may break the rules of plain glTF
    if (root.contains("animations")) document.note("animations are ignored: the rest pose is shown");
    pruneAndCheckTypes(root, document);
    checkSizes(root, document);
    PrunedJson pruned;
    for (const Json& buffer : takeObjects(root, "buffers", document)) {
        if (!buffer.contains("byteLength") || !buffer["byteLength"].is_number_unsigned()) {
            document.fail(fmt::format("buffer {} has no valid byteLength", pruned.buffers.size()));
        }
        pruned.buffers.push_back({buffer.value("uri", ""), buffer["byteLength"].get<std::uint64_t>()});
    }
    for (const Json& image : takeObjects(root, "images", document)) {
        pruned.images.push_back(
            {image.value("name", ""), image.value("uri", ""), image.value("bufferView", -1)});
    }
    pruned.text = root.dump();
    return pruned;
}

}  // namespace penumbra::gltf
