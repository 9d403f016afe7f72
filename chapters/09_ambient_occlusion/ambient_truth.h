// The exact answers of ambient occlusion, for whole pictures: chapters 09, 10 and 11 compare with them.
#pragma once

#include "chapters/09_ambient_occlusion/ambient_options.h"
#include "common/app/chapter.h"
#include "common/truth/truth_image.h"

namespace penumbra {

/// Ambient visibility about the shading normal at each pixel, 1 channel. Cosine-weighted and without a range,
/// in a scene of at most `exactTriangles` triangles: exact, by cone subtraction of all triangles from the
/// whole sky. Otherwise `rays.count` rays in two independent halves, whose difference tells the standard
/// error of the picture: it is stated in `method` (4096 rays: about 0.001 where the sky is half covered).
/// Pixels above which there is nothing are exact in any case. `rays.nothingAbove` is ignored.
TruthImage ambientTruth(const TruthRequest& request, const AmbientRays& rays);

/// The bent vector of AmbientValue, 3 channels, not normalised, by rays.
TruthImage bentVectorTruth(const TruthRequest& request, const AmbientRays& rays);

/// Light that arrives by the shading normal, 3 channels: pi times the mean of the radiance of the open
/// directions, by rays, and the sun's. With uniform weighting: of what is counted so.
TruthImage skyIrradianceTruth(const TruthRequest& request, const AmbientRays& rays, const SkyLight& light);

inline constexpr std::size_t exactTriangles = 200;

/// Ambient visibility (cosine-weighted, all occluders) of one point, in closed form: the sky is a box around
/// the scene, and each of its faces a light. `normal` unit, on the side of hit.geometricNormal. Takes time in
/// proportion to the triangles above the point, squared where they overlap.
class ExactAmbient {
 public:
    explicit ExactAmbient(const Scene& scene);
    ~ExactAmbient();
    ExactAmbient(const ExactAmbient&) = delete;
    ExactAmbient& operator=(const ExactAmbient&) = delete;
    double visibility(const Hit& hit, const glm::dvec3& normal) const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace penumbra
