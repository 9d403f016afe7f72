#include "chapters/08_accumulation/texture_room.h"

#include <fmt/format.h>

#include "chapters/08_accumulation/texel_target.h"
#include "common/error.h"

namespace penumbra {

namespace {

/// Bytes of a texel in the formats of texel_target.h: RGBA32F, one value of it, and what is drawn into next
/// to it (a depth for each four texels, or a hard shadow image).
constexpr std::int64_t color = 16, value = 4, beside = 1;

std::int64_t bytesOfALight(const AccumulationOptions& options, const Light& light) {
    if (options.method != "mask") return value + color + beside;
    const int points = light.type == LightType::area ? options.samples : 1;
    const int layers = (points + MaskLayers::pointsInLayer - 1) / MaskLayers::pointsInLayer;
    return value + 2 * value + beside + std::int64_t(layers) * MaskLayers::pointsInLayer / 8;
}

}  // namespace

std::int64_t textureBytes(const AccumulationOptions& options, const Scene& scene,
                          const std::vector<Receiver>& receivers) {
    std::int64_t perTexel = color;
    for (const int light : options.chosenLights(scene))
        perTexel += bytesOfALight(options, scene.lights[std::size_t(light)]);
    return perTexel * texelCount(receivers);
}

void requireTextureRoom(const AccumulationOptions& options, const Scene& scene,
                        const std::vector<Receiver>& receivers) {
    const std::int64_t bytes = textureBytes(options, scene, receivers);
    if (bytes <= mostTextureBytes) return;
    throw UsageError(fmt::format(
        "--samples {} on {} texels of {} receivers would take {} MB, more than {}: choose fewer samples, a "
        "smaller --texel-budget or --texels-per-metre, or --method accumulate, which keeps no masks",
        options.samples, texelCount(receivers), receivers.size(), bytes >> 20, mostTextureBytes >> 20));
}

}  // namespace penumbra
