#include "chapters/09_ambient_occlusion/bake_file.h"

#include <string>

#include "common/error.h"
#include "common/image/file_write.h"
#include "common/scene/glb_writer.h"

namespace penumbra {

void saveAmbient(const Scene& scene, std::span<const AmbientValue> values,
                 const std::filesystem::path& file) {
    if (values.size() != scene.positions.size())
        throw Error("cannot save " + std::to_string(values.size()) + " ambient values for the " +
                    std::to_string(scene.positions.size()) + " vertices of scene '" + scene.name + "'");
    std::vector<glm::vec4> ambient;
    for (const AmbientValue& value : values) ambient.emplace_back(value.bent, value.visibility);
    writeFile(file, glbOf(scene, ambient));
}

void requireSavable(const std::filesystem::path& file) {
    if (file.extension() != ".glb") throw UsageError("--save " + file.string() + ": must end in .glb");
    requireWritable(file);
}

std::optional<std::vector<AmbientValue>> loadedAmbient(const Scene& scene) {
    if (scene.ambient.empty()) return std::nullopt;
    std::vector<AmbientValue> values;
    for (const glm::vec4& ambient : scene.ambient) values.push_back({ambient.w, glm::dvec3(ambient)});
    return values;
}

}  // namespace penumbra
