// What the second pass needs to know about the map of the first.
#pragma once

#include <string>

#include "chapters/01_depth_from_light/shadow_options.h"

namespace penumbra {

/// Declares --outside.
void declareOutside(Parameters& parameters, std::string& outside);

/// Sets the uniforms of shadowed.vert and shadow_lookup.glsl. A point behind a spot or area light is dark
/// whatever `outside` says, since nothing is emitted there; behind a point light's map it is only outside the
/// map.
void setShadowMap(Program& program, const ShadowMap& map, const LightFrustum& frustum, const Light& light,
                  const std::string& outside);

}  // namespace penumbra
