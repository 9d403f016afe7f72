// A glTF file taken apart: the JSON as tinygltf's structures, the buffers as bytes. Internal to the loader.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace penumbra::gltf {

using Bytes = std::span<const std::uint8_t>;

/// An entry of the file's "images". Neither fetched nor decoded until a material needs it.
struct ImageSource {
    std::string name;
    std::string uri;  ///< empty: in a buffer view
    int bufferView = -1;
};

/// tinygltf sees the structure only: buffers, images, extras and animations are taken out of the JSON before.
/// It would otherwise load a GLB's whole binary chunk once per entry of "buffers", hand out images by
/// unchecked offsets, and recurse as deep as "extras" is nested.
struct Document {
    std::string name;                     ///< of the file: the "where" of every message
    std::filesystem::path baseDirectory;  ///< external files are looked up here; empty: refused
    std::unique_ptr<tinygltf::Model> model;
    std::vector<Bytes> buffers;  ///< each at least its byteLength, cut to it
    std::vector<ImageSource> images;
    std::vector<std::string> notes;
    std::deque<std::vector<std::uint8_t>>
        owned;                        ///< what `buffers` points into, unless it is the file itself
    std::uint64_t externalBytes = 0;  ///< fetched so far
    std::uint64_t elementsRead = 0;   ///< accessor elements decoded so far

    Document();
    Document(Document&&) noexcept;
    Document& operator=(Document&&) = delete;
    ~Document();

    /// Throws Error "NAME: what", as one printable line however hostile `what` is.
    [[noreturn]] void fail(const std::string& what) const;
    /// Adds to `notes` unless it is there already.
    void note(const std::string& text);
    /// The bytes of a buffer view. `who` names the user in the message.
    Bytes viewBytes(int bufferView, const std::string& who) const;
};

/// `bytes` must outlive the document. Throws Error.
Document parseDocument(Bytes bytes, const std::string& name, const std::filesystem::path& baseDirectory);

/// The JSON and the binary chunk of a GLB; any other file is all JSON.
struct Container {
    Bytes json;
    Bytes binary;
    bool isBinary = false;
};
Container splitContainer(Bytes file, const Document& document);

/// `text` as one line of at most `limit` printable bytes: names in a hostile file hold anything.
std::string printable(const std::string& text, std::size_t limit = 300);

}  // namespace penumbra::gltf
