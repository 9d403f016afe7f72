// What chapters 02 and 03 would show in place of a chapter under test: their programs, fed as their main.cpp
// feeds them.
#pragma once

#include "chapters/02_shadow_test/shadow_test.h"
#include "chapters/03_polygon_offset/depth_bias.h"
#include "tests/image/chapter_harness.h"

namespace penumbra {

/// A map, the state that both chapters set, then `setRest`.
template <class SetRest>
FloatImage visibilityBy(ChapterHarness& harness, const glm::ivec2& size, Program& program,
                        const SetRest& setRest) {
    Program depth("01_depth_from_light/depth.vert", "01_depth_from_light/depth.frag");
    ShadowOptions options;
    std::optional<ShadowMap> held;
    const Frame frame = harness.frame("visibility", size);
    ShadowMap& map = options.provide(held, harness.capabilities());
    const Light& light = options.chosenLight(frame.scene);
    const LightFrustum frustum =
        fitLightFrustum(frame.scene, light, frame.camera, double(size.x) / size.y, depthRange(map.format()));
    map.render(depth, frame, light, frustum);
    clearPicture(frame, options);
    glEnable(GL_DEPTH_TEST);
    setCameraAndLight(program, frame, options);
    setShadowMap(program, map, frustum, light, "lit");
    setRest(frame, map, frustum);
    program.set("uView", 1);
    drawPicture(program, frame);
    return harness.readBack(1);
}

inline FloatImage visibilityOfChapter02(ChapterHarness& harness, const glm::ivec2& size) {
    Program shadowed("02_shadow_test/shadowed.vert", "02_shadow_test/shadowed.frag");
    return visibilityBy(harness, size, shadowed, [](const Frame&, const ShadowMap&, const LightFrustum&) {});
}

/// `method`: slope or receiverPlane.
inline FloatImage visibilityOfChapter03(ChapterHarness& harness, const glm::ivec2& size, BiasMethod method) {
    Program biased("02_shadow_test/shadowed.vert", "03_polygon_offset/biased.frag", biasDefines(method));
    return visibilityBy(
        harness, size, biased, [&](const Frame& frame, const ShadowMap& map, const LightFrustum& frustum) {
            setDepthErrors(biased, bothPassesErrors(map, frustum, frame.scene.bounds), frustum);
            biased.setTexture("uSecondLayer", GL_TEXTURE_2D, map.texture());
            biased.set("uBias", 1.0f);
            biased.set("uConstantBias", 0.0f);
        });
}

}  // namespace penumbra
