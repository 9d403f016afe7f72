#include "chapters/11_bent_normals/sky_irradiance.h"

#include <numbers>
#include <utility>

namespace penumbra {

namespace {

TexelTexture textureOf(const IrradianceMap& map) {
    std::vector<float> texels;
    for (int row = 0; row < map.texels.height; ++row)
        for (int column = 0; column < map.texels.width; ++column) {
            for (int c = 0; c < 3; ++c) texels.push_back(map.texels.at(column, row, c));
            texels.push_back(1.0f);
        }
    TexelTexture texture(glm::ivec2(map.texels.width, map.texels.height), GL_RGBA32F);
    texture.upload(texels);
    return texture;
}

}  // namespace

int SkyIrradiance::update(const Scene& scene, const BentOptions& options) {
    if (sky_ != options.sky) {
        const Sky& sky = options.skyOf(scene);
        samples_ = sampleSky([&](const glm::dvec3& w) { return sky.radiance(w); });
        harmonics_ = ShIrradiance::of(*samples_);
        linear_ = LinearSky::of(*samples_);
        map_.reset();
        sky_ = options.sky;
    }
    if (options.irradiance != "map") return 0;
    if (!map_) {
        map_ = textureOf(smallestIrradianceMap(CosineConvolution(std::move(*samples_))));
        samples_.reset();
    }
    return map_->size().y;
}

std::vector<std::string> SkyIrradiance::defines(const BentOptions& options) const {
    if (options.irradiance == "normalised") return {"LINEAR", "NORMALISED"};
    return {options.irradiance == "sh" ? "HARMONICS" : options.irradiance == "map" ? "MAP" : "LINEAR"};
}

void SkyIrradiance::set(Program& program, const BentOptions& options) const {
    if (options.irradiance == "sh") {
        std::vector<glm::vec4> factors;
        for (const glm::dvec3& factor : harmonics_.polynomial())
            factors.emplace_back(glm::vec3(factor), 0.0f);
        program.set("uHarmonics", factors);
    } else if (options.irradiance == "map") {
        program.setTexture("uIrradianceMap", GL_TEXTURE_2D, map_->id());
    } else {
        program.set("uMean", glm::vec3(linear_.mean));
        program.set("uGradient", glm::mat3(linear_.gradient));
    }
}

}  // namespace penumbra
