#include "chapters/01_depth_from_light/depth_view.h"

namespace penumbra {

DepthView::DepthView() : program_("common/fullscreen.vert", "01_depth_from_light/show_depth.frag") {}

void DepthView::draw(const Frame& frame, const ShadowMap& map, const LightFrustum& frustum, bool linear) {
    program_.setTexture("uShadowMap", GL_TEXTURE_2D, map.texture());
    program_.set("uPictureSize", frame.size);
    program_.set("uLinear", linear);
    program_.set("uOrthographic", frustum.orthographic);
    program_.set("uReversed", frustum.range == DepthRange::reversed);
    program_.set("uNearFar", glm::vec2(frustum.near, frustum.far));
    program_.prepareToDraw();
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
}

}  // namespace penumbra
