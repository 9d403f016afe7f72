#include "common/scene/gltf_accessor.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>

#include "common/scene/gltf_limits.h"

namespace penumbra::gltf {
namespace {

/// `count` elements of `elementBytes`, `stride` apart, all inside `bytes`.
struct Elements {
    Bytes bytes;
    std::size_t count = 0;
    std::size_t stride = 0;
    const std::uint8_t* at(std::size_t i) const { return bytes.data() + i * stride; }
};

Elements elementsAt(const Document& document, int bufferView, std::size_t byteOffset, std::size_t count,
                    std::size_t stride, std::size_t elementBytes, const std::string& who) {
    const Bytes view = document.viewBytes(bufferView, who);
    const std::size_t room = byteOffset <= view.size() ? view.size() - byteOffset : 0;
    // Divided, not multiplied: count * stride may overflow.
    const bool fits = count == 0 || (room >= elementBytes && count - 1 <= (room - elementBytes) / stride);
    if (!fits) {
        document.fail(
            fmt::format("{}: {} elements of {} bytes, {} apart, from byte {} on reach beyond the {} bytes of "
                        "bufferView {}",
                        who, count, elementBytes, stride, byteOffset, view.size(), bufferView));
    }
    return {view.subspan(std::min(byteOffset, view.size())), count, stride};
}

const tinygltf::Accessor& accessorAt(const Document& document, int index, const std::string& who) {
    const auto& accessors = document.model->accessors;
    if (index < 0 || std::size_t(index) >= accessors.size()) {
        document.fail(
            fmt::format("{} refers to accessor {}, and there are {}", who, index, accessors.size()));
    }
    return accessors[std::size_t(index)];
}

template <class T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// One component as float; integers are scaled to [0,1] or [-1,1] when normalized (glTF 2.0, 3.6.2.2
/// ... 3.11).
float component(const std::uint8_t* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const float v = load<std::int8_t>(bytes);
            return normalized ? std::max(v / 127.0f, -1.0f) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
            const float v = load<std::uint8_t>(bytes);
            return normalized ? v / 255.0f : v;
        }
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const float v = load<std::int16_t>(bytes);
            return normalized ? std::max(v / 32767.0f, -1.0f) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
            const float v = load<std::uint16_t>(bytes);
            return normalized ? v / 65535.0f : v;
        }
        default:
            return load<float>(bytes);
    }
}

std::uint32_t unsignedComponent(const std::uint8_t* bytes, int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return load<std::uint8_t>(bytes);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<std::uint16_t>(bytes);
    return load<std::uint32_t>(bytes);
}

bool isUnsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// True if `type` may be read by `component`.
bool isAllowed(int type, bool normalized, Integers integers) {
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) return true;
    const bool byteOrShort =
        type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    if (integers == Integers::normalizedUnsigned) return byteOrShort && isUnsigned(type) && normalized;
    return integers == Integers::any && byteOrShort;
}

std::size_t componentBytes(int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return 1;
    if (type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return 2;
    return 4;
}

void spend(Document& document, std::size_t elements, const std::string& who) {
    document.elementsRead += elements;
    if (elements > maxElementsRead || document.elementsRead > maxElementsRead) {
        document.fail(
            fmt::format("{}: the file asks for more than {} million vertices and indices; split the scene",
                        who, maxElementsRead / 1'000'000));
    }
}

/// Calls put(element number, bytes of the element) for the accessor's own bytes, then for its sparse
/// substitutes.
template <class Put>
void forEachElement(Document& document, const tinygltf::Accessor& accessor, std::size_t elementBytes,
                    const std::string& who, const Put& put) {
    if (accessor.bufferView >= 0) {
        document.viewBytes(accessor.bufferView, who);  // checked before its stride is read
        const std::size_t declared = document.model->bufferViews[std::size_t(accessor.bufferView)].byteStride;
        const Elements elements =
            elementsAt(document, accessor.bufferView, accessor.byteOffset, accessor.count,
                       declared == 0 ? elementBytes : declared, elementBytes, who);
        spend(document, elements.count, who);
        for (std::size_t i = 0; i < elements.count; ++i) put(i, elements.at(i));
    } else {
        if (accessor.count > maxZeroElements) {
            document.fail(fmt::format("{}: {} elements without bytes; at most {} are supported", who,
                                      accessor.count, maxZeroElements));
        }
        spend(document, accessor.count, who);
    }
    if (!accessor.sparse.isSparse) return;
    const auto& sparse = accessor.sparse;
    const std::string sparseWho = who + " (sparse)";
    if (sparse.count < 0 || std::size_t(sparse.count) > accessor.count || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0 || !isUnsigned(sparse.indices.componentType)) {
        document.fail(fmt::format("{}: count, offsets or component type out of range", sparseWho));
    }
    const std::size_t indexBytes = componentBytes(sparse.indices.componentType);
    const std::size_t count = std::size_t(sparse.count);
    const Elements indices =
        elementsAt(document, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), count,
                   indexBytes, indexBytes, sparseWho);
    const Elements values =
        elementsAt(document, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), count,
                   elementBytes, elementBytes, sparseWho);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t target = unsignedComponent(indices.at(i), sparse.indices.componentType);
        if (target >= accessor.count) {
            document.fail(fmt::format("{}: index {} of {} elements", sparseWho, target, accessor.count));
        }
        put(target, values.at(i));
    }
}

template <class Vector>
std::vector<Vector> readVectors(Document& document, int index, Integers integers, const std::string& who,
                                int type, const char* typeName) {
    const tinygltf::Accessor& accessor = accessorAt(document, index, who);
    if (accessor.type != type || !isAllowed(accessor.componentType, accessor.normalized, integers)) {
        document.fail(fmt::format("{}: accessor {} has the wrong type; a {} of {} is needed", who, index,
                                  typeName,
                                  integers == Integers::no ? "float" : "float or an allowed integer"));
    }
    const std::size_t size = componentBytes(accessor.componentType);
    std::vector<Vector> vectors;
    forEachElement(document, accessor, size * std::size_t(Vector::length()), who,
                   [&](std::size_t i, const std::uint8_t* bytes) {
                       if (vectors.empty())
                           vectors.resize(accessor.count, Vector(0.0f));  // its range is checked now
                       for (int c = 0; c < Vector::length(); ++c) {
                           vectors[i][c] = component(bytes + std::size_t(c) * size, accessor.componentType,
                                                     accessor.normalized);
                       }
                   });
    vectors.resize(accessor.count, Vector(0.0f));
    return vectors;
}

}  // namespace

std::vector<glm::vec3> readVec3(Document& document, int index, Integers integers, const std::string& who) {
    return readVectors<glm::vec3>(document, index, integers, who, TINYGLTF_TYPE_VEC3, "VEC3");
}

std::vector<glm::vec1> readScalars(Document& document, int index, Integers integers, const std::string& who) {
    return readVectors<glm::vec1>(document, index, integers, who, TINYGLTF_TYPE_SCALAR, "SCALAR");
}

std::vector<glm::vec2> readVec2(Document& document, int index, Integers integers, const std::string& who) {
    return readVectors<glm::vec2>(document, index, integers, who, TINYGLTF_TYPE_VEC2, "VEC2");
}

std::vector<std::uint32_t> readIndices(Document& document, int index, const std::string& who) {
    const tinygltf::Accessor& accessor = accessorAt(document, index, who);
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !isUnsigned(accessor.componentType) || accessor.normalized) {
        document.fail(fmt::format("{}: accessor {} is not of unsigned integers", who, index));
    }
    std::vector<std::uint32_t> indices;
    forEachElement(document, accessor, componentBytes(accessor.componentType), who,
                   [&](std::size_t i, const std::uint8_t* bytes) {
                       if (indices.empty()) indices.resize(accessor.count);
                       indices[i] = unsignedComponent(bytes, accessor.componentType);
                   });
    indices.resize(accessor.count);
    return indices;
}

std::size_t accessorCount(const Document& document, int index, const std::string& who) {
    return accessorAt(document, index, who).count;
}

}  // namespace penumbra::gltf
