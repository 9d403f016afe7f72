// What one light has to do with one receiver: what need not be drawn, and from where the rest is.
#pragma once

#include <cstdint>
#include <vector>

#include "chapters/08_accumulation/light_points.h"
#include "chapters/08_accumulation/projection.h"
#include "chapters/08_accumulation/reach.h"
#include "chapters/08_accumulation/receiver.h"
#include "common/app/skips.h"

namespace penumbra {

inline constexpr Skip receiversUnreached{
    "receivers-unreached", "receivers_shadowed",
    "no light point is asked for a receiver that nothing can shadow: all "
    "of the light arrives"};
inline constexpr Skip clustersNotBetween{"clusters-not-between", "occluders_drawn",
                                         "clusters of triangles outside the space between light and receiver "
                                         "are not projected: they cover no texel of it"};
inline constexpr Skip texelsUnreached{"texels-unreached", "texels_in_reach",
                                      "blocks of texels that no triangle can shadow are not weighed: all of "
                                      "the light arrives"};

struct ShadowPlan {
    bool receives = false;  ///< false: the receiver faces away, or lies behind the light: dark everywhere
    bool reached = false;   ///< false: nothing comes in between: lit from the closed form, without a sample
    Occluders occluders;
    bool cullClosed = true;                       ///< false: the light lies in the box of a closed part
    std::vector<LightPoint> points;               ///< above the receiver's plane; the others give it nothing
    std::vector<ReceiverProjection> projections;  ///< of each point
    std::vector<glm::vec2> texels;  ///< triangles, three corners each: the blocks a shadow may reach
    std::int64_t texelsInReach = 0;
};

/// The same for all texels.
std::vector<glm::vec2> wholeTexture(const glm::ivec2& texels);

/// `skips`: the three above. With all of them off the plan's clusters are those of the whole scene, and every
/// part may shadow every texel but the light's own, which OccluderPass leaves out: the same shadows.
ShadowPlan planShadows(const Scene& scene, const Receiver& receiver, const Light& light,
                       const std::vector<LightPoint>& points, const Skips& skips);

/// The light points as weight.glsl wants them: metres from the receiver's corner, u edge along x; scaled so
/// that the weights of all points add up to at most 1 at any texel. Zero where `on` is false.
struct PointWeights {
    std::vector<glm::vec4> values;
    double scale = 1.0;  ///< of the weights; without it they are irradiance over (radiance times cosine at
                         ///< the light times r)
};
PointWeights pointWeights(const Receiver& receiver, const std::vector<LightPoint>& points,
                          const std::vector<bool>& on);

/// The receiver's edges in metres, u along x.
struct PlaneEdges {
    glm::vec2 u{1.0f, 0.0f}, v{0.0f, 1.0f};
};
PlaneEdges planeEdges(const Receiver& receiver);

/// The height in metres of the receiver's point (u, v) in front of the light's plane: dot(., (u, v, 1)).
/// Lights that have no plane: 1 everywhere.
glm::vec3 heightInFrontOf(const Light& light, const Receiver& receiver);

}  // namespace penumbra
