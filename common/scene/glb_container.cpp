#include "common/scene/glb_container.h"

#include <cstddef>

namespace penumbra {

namespace {

void appendWord(std::string& out, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out.push_back(char(value >> shift & 255u));
}

}  // namespace

std::string glbContainer(std::string json, std::string_view binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string out;
    out.reserve(28 + json.size() + binary.size());
    appendWord(out, 0x46546C67u);  // "glTF"
    appendWord(out, 2);
    appendWord(out, 12 + 8 + json.size() + 8 + binary.size());
    appendWord(out, json.size());
    appendWord(out, 0x4E4F534Au);  // "JSON"
    out += json;
    appendWord(out, binary.size());
    appendWord(out, 0x004E4942u);  // "BIN"
    return out.append(binary);
}

}  // namespace penumbra
