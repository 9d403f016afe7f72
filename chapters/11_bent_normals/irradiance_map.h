// Irradiance of a sky as a picture: E(n) for every direction n, the sky convolved with the cosine.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "chapters/11_bent_normals/sky_samples.h"
#include "common/image/image.h"

namespace penumbra {

/// E(n) = sum of power max(0, n.w) over all samples of a sky. Groups of neighbouring samples that lie above
/// the horizon of n as a whole count as one vector, and those below not at all; only those that it cuts are
/// summed one by one. So the sum is the same, for a fraction of the work.
class CosineConvolution {
 public:
    explicit CosineConvolution(SkySamples sky);
    /// Irradiance on an unoccluded plane with unit normal `n`.
    glm::dvec3 irradiance(const glm::dvec3& n) const;
    /// The same without groups.
    glm::dvec3 irradianceOneByOne(const glm::dvec3& n) const;

 private:
    struct Group {
        int row, column;        ///< first sample
        glm::dvec3 axis;        ///< unit
        double sine;            ///< of its half angle about the axis
        glm::dmat3 power{0.0};  ///< sum of power times direction^T
    };
    glm::dvec3 sumOf(const Group& group, const glm::dvec3& n) const;

    SkySamples sky_;
    std::vector<Group> groups_;
};

/// A latitude-longitude picture of E. Unlike in a picture of radiance the top row IS the pole, and the bottom
/// row the other, so that bilinear look-up is continuous everywhere; column 0 looks along -z and columns
/// grow towards +x.
struct IrradianceMap {
    FloatImage texels;   ///< 3 channels, 2^k + 1 rows, 2^(k+1) columns
    double rmse = 0.0;   ///< of a look-up, relative to the largest E: over directions all round
    double worst = 0.0;  ///< of these, the same

    /// Bilinear; the twin of mapIrradiance in shaders/11_bent_normals/irradiance.glsl.
    glm::dvec3 at(const glm::dvec3& n) const;
};

/// With 2^`level` + 1 rows.
IrradianceMap convolveSky(const CosineConvolution& sky, int level);
/// The smallest whose rmse is at most `tolerance`, 5 to 65 rows.
IrradianceMap smallestIrradianceMap(const CosineConvolution& sky, double tolerance = 2e-3);

}  // namespace penumbra
