// What the rays of a point's neighbours say about the point.
//
// Neighbours look at nearly the same surroundings, each with rays of its own, so that together they know more
// than each alone. But their values differ: along the surface, with the normal, and with how deep a point
// lies between its own neighbours. So through the values of about forty neighbours a small function of these
// is laid (linear, and of second degree along the surface), the one that is most probable a posteriori
// (C. E. Rasmussen & C. K. I. Williams, "Gaussian Processes for Machine Learning", 2006, ch. 2: regression
// with a prior on the coefficients). What the function leaves unexplained is compared with the noise of the
// rays, which is known because each point's rays come in two halves: if it is more than noise, it is what the
// neighbours cannot know, and enters the variance of what they say. Near a sharp edge that variance is large,
// the point relies on its own rays, and gets more of them. A plain average would blur the edge: one would see
// the bottom of a gully too bright and its rim too dark.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "chapters/09_ambient_occlusion/vertex_bake_neighbours.h"
#include "chapters/09_ambient_occlusion/vertex_bake_points.h"

namespace penumbra {

/// What a point's own rays found.
struct OwnEstimate {
    glm::vec4 value{0.0f};  ///< bent vector, and visibility in w
    /// A quarter of the squared difference of the visibilities by one half of the rays and by the other: with
    /// halves that are independent, its expectation would be the variance of the visibility.
    float halves = 0.0f;
};

/// What its neighbours say.
struct NeighbourEstimate {
    glm::vec4 value{0.0f};
    float variance = 0.0f;  ///< of `value.w`; infinity if there are too few neighbours
    float noise = 0.0f;     ///< variance of the point's own visibility
};

class SharedRays {
 public:
    /// Keeps references to all.
    SharedRays(const BakePoints& points, const PointNeighbours& neighbours, std::span<const OwnEstimate> own);

    /// To be called when `own` has changed.
    void update();
    /// For point `i`. May run on many threads.
    NeighbourEstimate at(std::uint32_t i) const;

    std::size_t bytes() const { return 2 * depths_.size() * sizeof(float); }

 private:
    template <class Body>
    void forEachPoint(const Body& body) const;
    std::span<const std::uint32_t> around(std::uint32_t i) const;
    float depthOf(std::uint32_t i) const;
    float noiseAround(std::uint32_t i) const;

    const BakePoints& points_;
    const PointNeighbours& neighbours_;
    std::span<const OwnEstimate> own_;
    std::vector<float> depths_, noises_;  ///< of each point
};

/// The mean of two estimates of variances `variance` and `otherVariance`, weighted so that its own, the
/// return value, is least; stored in `value`. A variance may be infinite, but not both.
float combine(glm::vec4& value, float variance, const glm::vec4& other, float otherVariance);

/// The threshold t such that the mean of min(variance, t) over all `variances` is `mean`; infinity if it is
/// less anyway.
float thresholdOfMean(std::vector<float> variances, double mean);

}  // namespace penumbra
