// The bytes behind a URI of a glTF file: embedded base64, or a file beside it. Internal to the loader.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/scene/gltf_document.h"

namespace penumbra::gltf {

/// Throws Error: not there, not a regular file, too large, an absolute path or one with "..", another scheme
/// than data:.
std::vector<std::uint8_t> fetchUri(const std::string& uri, Document& document, const std::string& who);

/// RFC 3986 percent-decoding; a % that is not followed by two hexadecimal digits stays as it is.
std::string percentDecode(const std::string& text);

}  // namespace penumbra::gltf
