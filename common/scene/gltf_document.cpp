#include "common/scene/gltf_document.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>

#include "common/error.h"
#include "common/scene/gltf_json.h"
#include "common/scene/gltf_limits.h"
#include "common/scene/gltf_uri.h"

namespace penumbra::gltf {
namespace {

constexpr std::uint32_t glbMagic = 0x46546C67;     // "glTF"
constexpr std::uint32_t jsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binaryChunk = 0x004E4942;  // "BIN\0"

/// Little-endian, wherever it lies.
std::uint32_t wordAt(Bytes bytes, std::size_t offset) {
    return std::uint32_t(bytes[offset]) | std::uint32_t(bytes[offset + 1]) << 8 |
           std::uint32_t(bytes[offset + 2]) << 16 | std::uint32_t(bytes[offset + 3]) << 24;
}

/// The chunk at `offset`: its type and content. `offset` moves behind it.
std::pair<std::uint32_t, Bytes> nextChunk(Bytes file, std::size_t& offset, const Document& document) {
    if (file.size() - offset < 8)
        document.fail("truncated: a GLB chunk header is missing; get the file again");
    const std::uint32_t length = wordAt(file, offset);
    const std::uint32_t type = wordAt(file, offset + 4);
    offset += 8;
    if (length > file.size() - offset) {
        document.fail(fmt::format("truncated: a GLB chunk of {} bytes has only {}; get the file again",
                                  length, file.size() - offset));
    }
    const Bytes content = file.subspan(offset, length);
    offset += length;
    return {type, content};
}

std::string oneLine(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

void parseStructure(const std::string& json, Document& document) {
    tinygltf::TinyGLTF parser;
    std::string error, warning;
    bool fine = false;
    try {
        fine = parser.LoadASCIIFromString(document.model.get(), &error, &warning, json.c_str(),
                                          static_cast<unsigned int>(json.size()), "");
    } catch (const std::exception& exception) {  // nlohmann's, through tinygltf
        error += exception.what();
    }
    // tinygltf drops a primitive it can't read, returns true, and leaves only a message.
    if (!fine || !error.empty()) {
        document.fail(
            fmt::format("not a valid glTF 2.0 file: {}", error.empty() ? "no reason given" : oneLine(error)));
    }
}

void fetchBuffers(const std::vector<BufferSource>& sources, const Container& container, Document& document) {
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const BufferSource& source = sources[i];
        const std::string who = fmt::format("buffer {}", i);
        Bytes bytes;
        if (!source.uri.empty()) {
            document.owned.push_back(fetchUri(source.uri, document, who));
            bytes = document.owned.back();
        } else if (i == 0 && container.isBinary) {
            bytes = container.binary;
        } else {
            document.fail(
                fmt::format("{} has no uri, and only the first buffer of a .glb may do without", who));
        }
        if (bytes.size() < source.byteLength) {
            document.fail(
                fmt::format("{} should have {} bytes and has {}: the file is truncated; get it again", who,
                            source.byteLength, bytes.size()));
        }
        document.buffers.push_back(bytes.first(source.byteLength));
    }
}

}  // namespace

Document::Document() : model(std::make_unique<tinygltf::Model>()) {}
Document::Document(Document&&) noexcept = default;
Document::~Document() = default;

std::string printable(const std::string& text, std::size_t limit) {
    std::string line = text.substr(0, limit);
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    if (text.size() > limit) line += "...";
    return line;
}

void Document::fail(const std::string& what) const {
    throw Error(fmt::format("{}: {}", printable(name), printable(what, 600)));
}

void Document::note(const std::string& text) {
    const std::string line = printable(text);
    if (std::find(notes.begin(), notes.end(), line) == notes.end() && notes.size() < 100)
        notes.push_back(line);
}

Bytes Document::viewBytes(int bufferView, const std::string& who) const {
    if (bufferView < 0 || std::size_t(bufferView) >= model->bufferViews.size()) {
        fail(fmt::format("{} refers to bufferView {}, and there are {}", who, bufferView,
                         model->bufferViews.size()));
    }
    const tinygltf::BufferView& view = model->bufferViews[std::size_t(bufferView)];
    if (view.buffer < 0 || std::size_t(view.buffer) >= buffers.size()) {
        fail(fmt::format("bufferView {} refers to buffer {}, and there are {}", bufferView, view.buffer,
                         buffers.size()));
    }
    const Bytes buffer = buffers[std::size_t(view.buffer)];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
        fail(fmt::format("bufferView {} (offset {}, length {}) reaches beyond the {} bytes of buffer {}",
                         bufferView, view.byteOffset, view.byteLength, buffer.size(), view.buffer));
    }
    return buffer.subspan(view.byteOffset, view.byteLength);
}

Container splitContainer(Bytes file, const Document& document) {
    if (file.size() < 4 || wordAt(file, 0) != glbMagic) return {file, {}, false};
    if (file.size() < 20) document.fail("truncated: too short for a GLB header; get the file again");
    if (wordAt(file, 4) != 2)
        document.fail(fmt::format("GLB version {}, only 2 is supported", wordAt(file, 4)));
    const std::uint32_t length = wordAt(file, 8);
    if (length > file.size() || length < 20) {
        document.fail(
            fmt::format("truncated: the GLB header says {} bytes, the file has {}", length, file.size()));
    }
    file = file.first(length);
    std::size_t offset = 12;
    Container container{{}, {}, true};
    const auto [type, json] = nextChunk(file, offset, document);
    if (type != jsonChunk) document.fail("the first chunk of the GLB is not JSON; export the file again");
    container.json = json;
    // A chunk of unknown type is to be skipped (glTF 2.0, 4.4.3); up to three bytes of padding may follow the
    // last.
    while (file.size() - offset >= 8) {
        const auto [next, content] = nextChunk(file, offset, document);
        if (next != binaryChunk) continue;
        container.binary = content;
        break;
    }
    return container;
}

Document parseDocument(Bytes bytes, const std::string& name, const std::filesystem::path& baseDirectory) {
    Document document;
    document.name = name;
    document.baseDirectory = baseDirectory;
    if (bytes.size() > maxFileBytes) document.fail("larger than 2 GiB: split the scene");
    const Container container = splitContainer(bytes, document);
    const PrunedJson pruned = pruneJson(container.json, document);
    document.images = pruned.images;
    parseStructure(pruned.text, document);
    fetchBuffers(pruned.buffers, container, document);
    return document;
}

}  // namespace penumbra::gltf
