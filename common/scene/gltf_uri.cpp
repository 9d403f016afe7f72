#include "common/scene/gltf_uri.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "common/scene/gltf_limits.h"

namespace penumbra::gltf {
namespace {

namespace fs = std::filesystem;

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Value of each base64 character (RFC 4648), -1 for any other.
std::array<std::int8_t, 256> base64Values() {
    std::array<std::int8_t, 256> values;
    values.fill(-1);
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i) values[std::uint8_t(alphabet[i])] = std::int8_t(i);
    return values;
}

std::vector<std::uint8_t> decodeBase64(const std::string& uri, std::size_t begin, const Document& document,
                                       const std::string& who) {
    static const std::array<std::int8_t, 256> values = base64Values();
    std::vector<std::uint8_t> bytes;
    bytes.reserve((uri.size() - begin) / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t i = begin; i < uri.size() && uri[i] != '='; ++i) {
        const int value = values[std::uint8_t(uri[i])];
        if (value < 0) document.fail(fmt::format("{}: the data: uri is not base64", who));
        bits = bits << 6 | std::uint32_t(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(std::uint8_t(bits >> count));
    }
    return bytes;
}

/// The path below the base directory, or an error if the URI means anything else.
fs::path resolve(const std::string& uri, const Document& document, const std::string& who) {
    const std::string decoded = percentDecode(uri);
    const auto refuse = [&](const char* why) {
        document.fail(fmt::format("{}: the uri {:?} {}; put the file beside the glTF file", who,
                                  printable(uri, 120), why));
    };
    if (document.baseDirectory.empty()) refuse("is an external file, and this glTF has no folder");
    if (decoded.find('\0') != std::string::npos) refuse("contains a zero byte");
    if (decoded.find('\\') != std::string::npos) refuse("contains a backslash");
    if (decoded.find(':') != std::string::npos) refuse("is not a relative path");
    const fs::path path(decoded);
    if (path.is_absolute()) refuse("is an absolute path");
    for (const fs::path& part : path) {
        if (part == "..") refuse("leaves the folder of the file");
    }
    return document.baseDirectory / path;
}

std::vector<std::uint8_t> readFile(const fs::path& path, Document& document, const std::string& who) {
    std::error_code error;
    const std::string file = printable(path.string(), 200);
    if (!fs::is_regular_file(path, error)) {
        document.fail(fmt::format("{}: {} is missing; copy it there together with the glTF file", who, file));
    }
    const std::uint64_t size = fs::file_size(path, error);
    document.externalBytes += size;
    if (error || size > maxFileBytes || document.externalBytes > maxExternalBytes) {
        document.fail(fmt::format("{}: {} is too large; split the scene", who, file));
    }
    std::vector<std::uint8_t> bytes(size);
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) {
        document.fail(fmt::format("{}: cannot read {}; check its permissions", who, file));
    }
    return bytes;
}

}  // namespace

std::string percentDecode(const std::string& text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '%' && text.size() - i > 2;
        const int high = escape ? hexDigit(text[i + 1]) : -1;
        const int low = escape ? hexDigit(text[i + 2]) : -1;
        if (high < 0 || low < 0) {
            decoded += text[i];
        } else {
            decoded += char(high * 16 + low);
            i += 2;
        }
    }
    return decoded;
}

std::vector<std::uint8_t> fetchUri(const std::string& uri, Document& document, const std::string& who) {
    if (uri.rfind("data:", 0) == 0) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos || comma < 7 || uri.compare(comma - 7, 7, ";base64") != 0) {
            document.fail(fmt::format("{}: only base64 data: uris are supported", who));
        }
        return decodeBase64(uri, comma + 1, document, who);
    }
    return readFile(resolve(uri, document, who), document, who);
}

}  // namespace penumbra::gltf
