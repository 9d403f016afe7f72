#include "chapters/09_ambient_occlusion/bake_file.h"

#include <cstring>
#include <fstream>
#include <iterator>

#include "common/error.h"
#include "common/image/file_write.h"
#include "common/scene/glb_writer.h"
#include "common/truth/truth_cache.h"

namespace penumbra {

namespace {

constexpr std::string_view formatName = "penumbra partial bake 1\n";
constexpr std::size_t hashDigits = 32;

/// Of a partial file: the name of the format, the key, a hash of what follows, the number of pieces, payload.
constexpr std::size_t headerBytes = formatName.size() + 2 * hashDigits + sizeof(std::uint64_t);

std::string hashOf(std::uint64_t done, std::string_view payload) {
    return ContentHash().number(std::int64_t(done)).text(payload).hex();
}

}  // namespace

void saveAmbient(const Scene& scene, std::span<const AmbientValue> values,
                 const std::filesystem::path& file) {
    if (values.size() != scene.positions.size())
        throw Error("cannot save " + std::to_string(values.size()) + " ambient values for the " +
                    std::to_string(scene.positions.size()) + " vertices of scene '" + scene.name + "'");
    std::vector<glm::vec4> ambient;
    for (const AmbientValue& value : values) ambient.emplace_back(value.bent, value.visibility);
    writeFile(file, glbOf(scene, ambient));
}

std::optional<std::vector<AmbientValue>> loadedAmbient(const Scene& scene) {
    if (scene.ambient.empty()) return std::nullopt;
    std::vector<AmbientValue> values;
    for (const glm::vec4& ambient : scene.ambient) values.push_back({ambient.w, glm::dvec3(ambient)});
    return values;
}

void savePartialBake(const std::filesystem::path& file, const std::string& key, std::uint64_t done,
                     std::string_view payload) {
    std::string bytes;
    bytes.reserve(headerBytes + payload.size());
    bytes.append(formatName).append(key).append(hashOf(done, payload));
    bytes.append(reinterpret_cast<const char*>(&done), sizeof done);
    bytes.append(payload);
    writeFile(file, bytes);
}

std::optional<PartialBake> loadPartialBake(const std::filesystem::path& file, const std::string& key) {
    std::ifstream in(file, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(in), {});
    if (bytes.size() < headerBytes || !bytes.starts_with(std::string(formatName) + key)) return std::nullopt;
    PartialBake partial;
    std::memcpy(&partial.done, bytes.data() + headerBytes - sizeof partial.done, sizeof partial.done);
    const std::string hash = bytes.substr(formatName.size() + hashDigits, hashDigits);
    partial.payload = bytes.erase(0, headerBytes);
    if (hash != hashOf(partial.done, partial.payload)) return std::nullopt;
    return partial;
}

}  // namespace penumbra
