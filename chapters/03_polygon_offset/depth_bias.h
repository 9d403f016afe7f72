// How far a depth may be off, and what each remedy asks of the two passes.
#pragma once

#include <string>
#include <vector>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "chapters/01_depth_from_light/shadow_map.h"

namespace penumbra {

/// The order is that of the constants in biased.frag.
enum class BiasMethod {
    none,
    constant,
    polygonOffset,
    slope,
    receiverPlane,
    normalOffset,
    frontFace,
    midpoint
};

const std::vector<std::string>& biasMethodNames();
/// Throws UsageError for an unknown name.
BiasMethod biasMethod(const std::string& name);

/// DepthErrors of both passes together: the caster's vertex transform in pass 1, the receiver's in pass 2,
/// and its interpolation from vertices to pixels (as long as a transform again).
DepthErrors bothPassesErrors(const ShadowMap& map, const LightFrustum& frustum, const Aabb& bounds);

/// The slides' epsilon for the constant method: what a plane at 60 degrees in the middle of the frustum asks
/// for, window depth.
float constantBias(const LightFrustum& frustum, int mapSize);

/// How `method` draws the casters: culling and glPolygonOffset. `scale` multiplies factor and units.
CasterDraw casterDraw(BiasMethod method, const ShadowMap& map, const LightFrustum& frustum,
                      const DepthErrors& errors, float scale);

/// Sets the uniforms of bias.glsl.
void setDepthErrors(Program& program, const DepthErrors& errors);

}  // namespace penumbra
