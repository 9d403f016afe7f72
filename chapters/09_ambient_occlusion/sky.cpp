#include "chapters/09_ambient_occlusion/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "common/error.h"
#include "common/image/image_file.h"
#include "common/text/spelling.h"

namespace penumbra {

struct Sky::Model {
    std::function<glm::dvec3(const glm::dvec3& direction)> radiance;
};

Sky Sky::of(std::function<glm::dvec3(const glm::dvec3&)> radiance) {
    Sky sky;
    sky.model_ = std::make_shared<Model>(Model{std::move(radiance)});
    return sky;
}

namespace {

/// Bilinear between texel centres; round the world in x, up to the poles in y.
glm::dvec3 lookUp(const FloatImage& picture, const glm::dvec2& uv) {
    const double x = uv.x * picture.width - 0.5;
    const double y = std::clamp(uv.y * picture.height - 0.5, 0.0, double(picture.height - 1));
    const int x0 = int(std::floor(x)), y0 = std::min(int(y), picture.height - 1);
    const auto texel = [&](int i, int j) {
        i = (i % picture.width + picture.width) % picture.width;
        j = std::min(j, picture.height - 1);
        return glm::dvec3(picture.at(i, j, 0), picture.at(i, j, 1), picture.at(i, j, 2));
    };
    const double s = x - x0, t = y - y0;
    return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), s),
                    glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), s), t);
}

/// A bright day over dry ground: white above, brown below, and half of each at the horizon. Linear in the
/// direction, so chapter 11 knows a look-up that is exact under it.
Sky gradientSky() {
    const glm::dvec3 above(1.0), below(0.25, 0.19, 0.13);
    return Sky::linear(0.5 * (above + below), {glm::dvec3(0.0), 0.5 * (above - below), glm::dvec3(0.0)});
}

/// Grey pictures get three channels, and alpha is dropped.
FloatImage inColour(const FloatImage& picture) {
    FloatImage colour(picture.width, picture.height, 3);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c) colour.at(x, y, c) = picture.at(x, y, picture.channels < 3 ? 0 : c);
    return colour;
}

}  // namespace

const std::vector<std::string>& Sky::names() {
    static const std::vector<std::string> all{"uniform", "overcast", "gradient"};
    return all;
}

glm::dvec2 latLongUv(const glm::dvec3& direction) {
    return {0.5 + std::atan2(direction.x, -direction.z) / (2.0 * std::numbers::pi),
            std::acos(std::clamp(direction.y, -1.0, 1.0)) / std::numbers::pi};
}

Sky Sky::uniform(const glm::dvec3& radiance) {
    return of([radiance](const glm::dvec3&) { return radiance; });
}

// [begin:overcast]
Sky Sky::overcast(const glm::dvec3& zenith) {
    const auto radiance = [zenith](const glm::dvec3& direction) {
        const double sine = direction.y;  // of the elevation
        return sine > 0.0 ? zenith * ((1.0 + 2.0 * sine) / 3.0) : glm::dvec3(0.0);
    };
    // [end:overcast]
    return of(radiance);
}

Sky Sky::linear(const glm::dvec3& mean, const glm::dmat3& gradient) {
    return of([mean, gradient](const glm::dvec3& direction) { return mean + gradient * direction; });
}

Sky Sky::latLong(FloatImage picture) {
    if (picture.width < 1 || picture.height < 1 || picture.channels != 3)
        throw Error("a sky needs a picture of 3 channels with at least one texel");
    for (const float value : picture.values)
        if (!(value >= 0.0f && std::isfinite(value)))
            throw Error("a sky cannot have radiance that is negative or no number; repair the picture");
    const auto radiance = [picture = std::move(picture)](const glm::dvec3& direction) {
        return lookUp(picture, latLongUv(direction));
    };
    return of(radiance);
}

Sky Sky::named(const std::string& nameOrFile) {
    if (nameOrFile == "uniform") return uniform(glm::dvec3(1.0));
    if (nameOrFile == "overcast") return overcast(glm::dvec3(1.0));
    if (nameOrFile == "gradient") return gradientSky();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(nameOrFile, ignored)) {
        throw UsageError(fmt::format("--sky {}: no such file, and none of {}{}", nameOrFile,
                                     joinNames(names()), didYouMean(nameOrFile, names())));
    }
    try {
        return latLong(inColour(readImage(nameOrFile)));
    } catch (const Error& error) {
        throw Error(fmt::format("--sky {}: {}", nameOrFile, error.what()));
    }
}

Sky Sky::times(double factor) const {
    return of([model = model_, factor](const glm::dvec3& w) { return factor * model->radiance(w); });
}

Sky Sky::onlySide(const glm::dvec3& side) const {
    return of([model = model_, side](const glm::dvec3& w) {
        return glm::dot(side, w) >= 0.0 ? model->radiance(w) : glm::dvec3(0.0);
    });
}

glm::dvec3 Sky::radiance(const glm::dvec3& direction) const {
    return model_->radiance(direction);
}

glm::dvec3 Sky::onOpenGround() const {
    // Cells of equal weight: equal steps of the azimuth and of the squared sine of the zenith angle.
    constexpr int around = 512, up = 128;
    glm::dvec3 sum(0.0);
    for (int j = 0; j < up; ++j) {
        const double sine2 = (j + 0.5) / up;
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + 0.5) / around;
            sum += radiance({std::sqrt(sine2) * std::cos(angle), std::sqrt(1.0 - sine2),
                             std::sqrt(sine2) * std::sin(angle)});
        }
    }
    return sum / double(around * up);
}

}  // namespace penumbra
