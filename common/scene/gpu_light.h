// Hands a light to the uniforms of shaders/common/light.glsl.
#pragma once

#include "common/gl/program.h"
#include "common/scene/light.h"

namespace penumbra {

/// Sets uLightType, uLightPosition, uLightDirection, uLightEmission and uLightCosines of `program`.
void setLight(Program& program, const Light& light);

}  // namespace penumbra
