// How far a depth may be off, and what each remedy asks of the two passes.
#pragma once

#include <string>
#include <vector>

#include "chapters/01_depth_from_light/depth_errors.h"
#include "chapters/01_depth_from_light/shadow_map.h"

namespace penumbra {

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

/// The defines that make biased.frag the program of `method`: METHOD, and the names that it is compared with.
std::vector<std::string> biasDefines(BiasMethod method);

/// DepthErrors of both passes together: the caster's vertex transform in pass 1, the receiver's in pass 2,
/// and its interpolation from vertices to pixels (as long as a transform again).
DepthErrors bothPassesErrors(const ShadowMap& map, const LightFrustum& frustum, const Aabb& bounds);

/// The slides' epsilon for the constant method: what a plane at 60 degrees in the middle of the frustum asks
/// for, window depth.
float constantBias(const LightFrustum& frustum, int mapSize);

/// uSteepest of depth_slope.glsl: no plane within 85 degrees of facing the light has |dz/du| + |dz/dv| above
/// this over q. Without a limit a surface edge-on to the light would get an endless bias.
float steepestSlope(const LightFrustum& frustum);

/// How `method` draws the casters: culling and glPolygonOffset. `scale` multiplies factor and units.
CasterDraw casterDraw(BiasMethod method, const LightFrustum& frustum, const DepthErrors& errors, float scale);

/// Sets the uniforms of bias.glsl and depth_slope.glsl.
void setDepthErrors(Program& program, const DepthErrors& errors, const LightFrustum& frustum);

}  // namespace penumbra
