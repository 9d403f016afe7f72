#include "chapters/02_shadow_test/shadow_test.h"

#include "common/error.h"

namespace penumbra {

void declareOutside(Parameters& parameters, std::string& outside) {
    parameters.add("outside", outside, {"lit", "dark"},
                   "points that the map does not cover; dark: a hard edge where the map ends");
}

std::vector<ViewInfo> shadowViews(const std::string& S, const std::string& visibility) {
    return {{"color", "Blinn-Phong with " + S},
            {"visibility", visibility, true, false},
            {"shadow-kind", "lit white, attached shadow blue, cast shadow red", false, false, 0.0},
            {"depth", "the shadow map", true, false}};
}

int viewNumber(const std::string& view) {
    return view == "visibility" ? 1 : view == "shadow-kind" ? 2 : 0;
}

void requireVisibility(const TruthRequest& request, const std::string& chapter) {
    if (request.view != "visibility")
        throw UsageError("--compare-truth: chapter " + chapter +
                         " has an exact answer for --view visibility");
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

void setPicture(Program& program, const Frame& frame, const ShadowOptions& options, const LightSight& sight,
                const std::string& outside) {
    setCameraAndLight(program, frame, options);
    setShadowMap(program, sight.map, sight.frustum, sight.light, outside);
}

}  // namespace penumbra
