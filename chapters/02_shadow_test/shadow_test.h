// Pass 2, as every chapter with a shadow test draws it: what it needs to know about the map of pass 1, and
// its views.
#pragma once

#include <string>
#include <vector>

#include "chapters/01_depth_from_light/light_pass.h"

namespace penumbra {

/// Declares --outside.
void declareOutside(Parameters& parameters, std::string& outside);

/// The views color, visibility, shadow-kind and depth. `S`: what the pictures show, e.g. "filtered S(x)".
std::vector<ViewInfo> shadowViews(const std::string& S, const std::string& visibility);

/// A view as shading.glsl numbers it.
int viewNumber(const std::string& view);

/// Throws UsageError unless the view is visibility, the only one with an exact answer.
void requireVisibility(const TruthRequest& request, const std::string& chapter);

/// Sets the uniforms of shadowed.vert and shadow_lookup.glsl. A point behind a spot or area light is dark
/// whatever `outside` says, since nothing is emitted there; behind a point light's map it is only outside the
/// map.
void setShadowMap(Program& program, const ShadowMap& map, const LightFrustum& frustum, const Light& light,
                  const std::string& outside);

/// The uniforms of setCameraAndLight and setShadowMap.
void setPicture(Program& program, const Frame& frame, const ShadowOptions& options, const LightSight& sight,
                const std::string& outside);

}  // namespace penumbra
