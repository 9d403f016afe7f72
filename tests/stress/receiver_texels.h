// A receiver's texture of light (chapter 08) as exact arithmetic fills it.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "common/scene/scene.h"
#include "tests/stress/case.h"

namespace penumbra::stress {

/// Of the scene's receivers those that hold triangle `triangle`, on the side of `normal`, as chapter 08 finds
/// them with the settings of settingsOf and that --minimum-area, m^2. None: it is too small for a texture.
std::vector<Receiver> receiversOf(const Scene& scene, std::uint32_t triangle, double minimumArea,
                                  const glm::dvec3& normal);

/// The four texels that a point is interpolated between; beyond the border, the border's.
struct TexelBlend {
    std::array<glm::ivec2, 4> texels;
    std::array<double, 4> weights;

    TexelBlend(const Receiver& receiver, const glm::dvec3& p);
    /// `at`: in texels, with texel i's centre at i.
    TexelBlend(const Receiver& receiver, const glm::dvec2& at);
    double of(const std::function<double(const glm::ivec2&)>& value) const;
    /// Largest difference of values: what the blend changes by for a texel's step.
    double range(const std::function<double(const glm::ivec2&)>& value) const;
};

struct Blended {
    double least = 0.0, most = 0.0;
};

/// What a blend of the texels may be anywhere within `beside` texels of `p` along each axis. Not the slope of
/// p's own cell: where a shadow begins in the next one, that is 0, and floats may have p beyond the border.
Blended blendedWithin(const Receiver& receiver, const glm::dvec3& p, double beside,
                      const std::function<double(const glm::ivec2&)>& value);

/// What arrives at a texel's centre from an area light of emission 1, nothing in between: Lambert's formula.
double unoccluded(const Receiver& receiver, const Light& light, const glm::ivec2& texel);

/// Of a pixel, by which a rasteriser may move a vertex.
double halfSubpixel();

/// Texels by which floats may have `p` beside its place in the texture: the shader's dot product.
double texelsBeside(const Receiver& receiver, const glm::dvec3& p);

}  // namespace penumbra::stress
