#include "chapters/02_shadow_test/shadow_test.h"

namespace penumbra {

void declareOutside(Parameters& parameters, std::string& outside) {
    parameters.add("outside", outside, {"lit", "dark"},
                   "points that the map does not cover; dark: a hard edge where the map ends");
}

void setShadowMap(Program& program, const ShadowMap& map, const LightFrustum& frustum, const Light& light,
                  const std::string& outside) {
    const bool lit = outside == "lit";
    program.setTexture("uShadowMap", GL_TEXTURE_2D, map.texture());
    program.set("uShadowTextureFromWorld", glm::mat4(frustum.textureFromWorld()));
    program.set("uFarther", frustum.range == DepthRange::reversed ? -1.0f : 1.0f);
    program.set("uOutsideLit", lit);
    program.set("uBehindLit", lit && light.type == LightType::point);
}

}  // namespace penumbra
