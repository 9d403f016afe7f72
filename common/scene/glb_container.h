// The container of binary glTF: what every writer of a .glb shares.
#pragma once

#include <string>
#include <string_view>

namespace penumbra {

/// A header, then `json` and `binary`, which must be a multiple of four bytes long, as the file's two chunks
/// (glTF 2.0, 4.4).
std::string glbContainer(std::string json, std::string_view binary);

}  // namespace penumbra
