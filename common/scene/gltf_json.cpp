#include "common/scene/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "common/scene/gltf_limits.h"

namespace penumbra::gltf {
namespace {

using Json = nlohmann::json;

constexpr std::array supportedExtensions = {
    std::string_view("KHR_lights_punctual"), std::string_view("KHR_materials_emissive_strength"),
    std::string_view("KHR_texture_transform"), std::string_view("KHR_mesh_quantization")};

/// Never used here, and the usual places for large or deep data.
constexpr std::array prunedKeys = {std::string_view("extras"), std::string_view("animations"),
                                   std::string_view("skins"),  std::string_view("samplers"),
                                   std::string_view("min"),    std::string_view("max")};

enum class Kind { integer, number, text, object, array };

struct KeyRule {
    std::string_view key;
    Kind kind;
};

/// glTF uses each of these keys with one type only. tinygltf takes an optional property of the wrong type as
/// absent, and the picture would be wrong without a word.
constexpr std::array keyRules = {KeyRule{"scene", Kind::integer},
                                 KeyRule{"mesh", Kind::integer},
                                 KeyRule{"camera", Kind::integer},
                                 KeyRule{"skin", Kind::integer},
                                 KeyRule{"material", Kind::integer},
                                 KeyRule{"mode", Kind::integer},
                                 KeyRule{"index", Kind::integer},
                                 KeyRule{"texCoord", Kind::integer},
                                 KeyRule{"bufferView", Kind::integer},
                                 KeyRule{"byteOffset", Kind::integer},
                                 KeyRule{"byteLength", Kind::integer},
                                 KeyRule{"byteStride", Kind::integer},
                                 KeyRule{"componentType", Kind::integer},
                                 KeyRule{"count", Kind::integer},
                                 KeyRule{"source", Kind::integer},
                                 KeyRule{"buffer", Kind::integer},
                                 KeyRule{"light", Kind::integer},
                                 KeyRule{"intensity", Kind::number},
                                 KeyRule{"range", Kind::number},
                                 KeyRule{"innerConeAngle", Kind::number},
                                 KeyRule{"outerConeAngle", Kind::number},
                                 KeyRule{"yfov", Kind::number},
                                 KeyRule{"znear", Kind::number},
                                 KeyRule{"zfar", Kind::number},
                                 KeyRule{"xmag", Kind::number},
                                 KeyRule{"ymag", Kind::number},
                                 KeyRule{"metallicFactor", Kind::number},
                                 KeyRule{"roughnessFactor", Kind::number},
                                 KeyRule{"emissiveStrength", Kind::number},
                                 KeyRule{"name", Kind::text},
                                 KeyRule{"uri", Kind::text},
                                 KeyRule{"type", Kind::text},
                                 KeyRule{"alphaMode", Kind::text},
                                 KeyRule{"version", Kind::text},
                                 KeyRule{"asset", Kind::object},
                                 KeyRule{"pbrMetallicRoughness", Kind::object},
                                 KeyRule{"baseColorTexture", Kind::object},
                                 KeyRule{"emissiveTexture", Kind::object},
                                 KeyRule{"attributes", Kind::object},
                                 KeyRule{"sparse", Kind::object},
                                 KeyRule{"extensions", Kind::object},
                                 KeyRule{"KHR_lights_punctual", Kind::object},
                                 KeyRule{"KHR_texture_transform", Kind::object},
                                 KeyRule{"KHR_materials_emissive_strength", Kind::object},
                                 KeyRule{"scenes", Kind::array},
                                 KeyRule{"nodes", Kind::array},
                                 KeyRule{"meshes", Kind::array},
                                 KeyRule{"accessors", Kind::array},
                                 KeyRule{"buffers", Kind::array},
                                 KeyRule{"bufferViews", Kind::array},
                                 KeyRule{"materials", Kind::array},
                                 KeyRule{"textures", Kind::array},
                                 KeyRule{"images", Kind::array},
                                 KeyRule{"cameras", Kind::array},
                                 KeyRule{"lights", Kind::array},
                                 KeyRule{"children", Kind::array},
                                 KeyRule{"primitives", Kind::array},
                                 KeyRule{"matrix", Kind::array},
                                 KeyRule{"rotation", Kind::array},
                                 KeyRule{"translation", Kind::array},
                                 KeyRule{"baseColorFactor", Kind::array},
                                 KeyRule{"emissiveFactor", Kind::array},
                                 KeyRule{"color", Kind::array},
                                 KeyRule{"extensionsUsed", Kind::array},
                                 KeyRule{"extensionsRequired", Kind::array}};

bool isKind(const Json& value, Kind kind) {
    switch (kind) {
        case Kind::integer:
            return value.is_number_integer();
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
    constexpr std::array names = {"an integer", "a number", "a string", "an object", "an array"};
    return names[std::size_t(kind)];
}

bool isSupported(const std::string& extension) {
    return std::find(supportedExtensions.begin(), supportedExtensions.end(), extension) !=
           supportedExtensions.end();
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
void checkTypes(Json& value, const Document& document) {
    if (!value.is_structured()) return;
    if (value.is_object()) dropUnsupportedExtensions(value);
    for (auto it = value.begin(); it != value.end(); ++it) {
        if (value.is_object()) {
            const auto rule = std::find_if(keyRules.begin(), keyRules.end(),
                                           [&](const KeyRule& r) { return r.key == it.key(); });
            if (rule != keyRules.end() && !isKind(*it, rule->kind)) {
                document.fail(fmt::format("\"{}\" is of type {}, and must be {}", it.key(), it->type_name(),
                                          kindName(rule->kind)));
            }
        }
        checkTypes(*it, document);
    }
}

Json parse(Bytes bytes, Document& document) {
    std::size_t values = 0;
    const auto keep = [&](int depth, Json::parse_event_t event, Json& parsed) {
        if (depth > maxJsonDepth) {
            document.fail(
                fmt::format("the JSON is nested more than {} deep, which no valid glTF is", maxJsonDepth));
        }
        if (event == Json::parse_event_t::key) {
            const auto& key = parsed.get_ref<const std::string&>();
            if (depth == 1 && key == "animations")
                document.note("animations are ignored: the rest pose is shown");
            return std::find(prunedKeys.begin(), prunedKeys.end(), key) == prunedKeys.end();
        }
        if (++values > maxJsonValues) {
            document.fail(fmt::format("more than {} JSON values: split the scene", maxJsonValues));
        }
        return true;
    };
    try {
        return Json::parse(bytes.begin(), bytes.end(), keep);
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
    checkTypes(root, document);
    checkSizes(root, document);
    checkExtensions(root, document);
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
