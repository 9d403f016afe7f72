// The exact answer of a fixed filter: hard visibility averaged over the kernel. Chapters 04 to 07 estimate
// it.
#pragma once

#include <optional>

#include "chapters/01_depth_from_light/light_frustum.h"
#include "chapters/01_depth_from_light/shadow_options.h"

namespace penumbra {

/// What is averaged over, on the light's map.
struct FilterKernel {
    enum class Shape { square, disk };
    Shape shape = Shape::square;
    double texels = 1.0;  ///< side of the square, radius of the disk
    int mapSize = 1024;   ///< texels along the whole map
};

/// The limit of percentage-closer filtering as maps grow finer and taps more, the kernel staying as wide as
/// it is on the light's map: the share of the kernel, projected along the light's rays to the plane of the
/// surface point, that sees the light (an area light counts as a point at its centre). `frustum`: the map's.
///
/// By shadow rays, decided in double: 64 Owen-scrambled points of the kernel, 1024 where they disagree. In a
/// penumbra the result is off by about 0.002 (root mean square), and a caster that the 64 points miss, which
/// covers a few hundredths of the kernel at most, is missed altogether.
class FilteredVisibility {
 public:
    /// Keeps references to the tracer, the light and the frustum.
    FilteredVisibility(const RayTracer& tracer, const Light& light, const LightFrustum& frustum,
                       const FilterKernel& kernel);
    /// `hit` faces the light. `seed`: of the random pattern.
    double at(const Hit& hit, std::uint32_t seed) const;

 private:
    int litOf(const Hit& hit, std::uint32_t seed, int first, int count) const;
    glm::dvec3 onReceiver(const Hit& hit, const glm::dvec2& uv) const;

    const RayTracer& tracer_;
    const Light& light_;
    const LightFrustum& frustum_;
    FilterKernel kernel_;
    double lift_;  ///< metres
};

/// The same for a picture, against "filter", with the chosen light and its map as a chapter with `options`
/// fits it.
TruthImage filterTruth(const TruthRequest& request, const ShadowOptions& options, const FilterKernel& kernel);

/// Chapter::areaLightTruth of a chapter with `options`: what the chosen light, if it is an area light, really
/// does.
std::optional<TruthImage> areaLightTruth(const TruthRequest& request, const ShadowOptions& options);

}  // namespace penumbra
