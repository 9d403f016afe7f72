// The JSON of a glTF file, checked and pruned before tinygltf sees it. Internal to the loader.
#pragma once

#include <string>
#include <vector>

#include "common/scene/gltf_document.h"

namespace penumbra::gltf {

struct BufferSource {
    std::string uri;  ///< empty: the binary chunk
    std::uint64_t byteLength = 0;
};

struct PrunedJson {
    std::string text;  ///< what is left for tinygltf
    std::vector<BufferSource> buffers;
    std::vector<ImageSource> images;
};

/// Throws Error for broken JSON, values of the wrong type, nesting or sizes beyond gltf_limits.h, and for a
/// required extension that is not supported (named in the message).
PrunedJson pruneJson(Bytes json, Document& document);

}  // namespace penumbra::gltf
