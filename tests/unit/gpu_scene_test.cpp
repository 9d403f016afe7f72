// Drawing a scene: what is skipped changes nothing, what is counted is what was drawn, materials and textures
// arrive.
#include "common/scene/gpu_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/gl/render_target.h"
#include "common/scene/camera.h"
#include "tests/image/mutated_shaders.h"
#include "tests/image/small_scenes.h"
#include "tests/unit/gl_contexts.h"

namespace penumbra {
namespace {

using Corners = std::array<glm::dvec3, 3>;

/// A ball of 2 * rings^2 triangles, closed: corners on one meridian or pole are equal to the bit.
std::vector<Corners> ball(const glm::dvec3& centre, double radius, int rings) {
    const auto at = [&](int ring, int sector) {
        const double polar = std::numbers::pi * ring / rings;
        const double around = 2.0 * std::numbers::pi * (sector % rings) / rings;
        const double sine = ring == 0 || ring == rings ? 0.0 : std::sin(polar);
        return centre +
               radius * glm::dvec3(sine * std::cos(around), std::cos(polar), -sine * std::sin(around));
    };
    std::vector<Corners> triangles;
    for (int r = 0; r < rings; ++r)
        for (int s = 0; s < rings; ++s) {
            if (r > 0) triangles.push_back({at(r, s), at(r + 1, s), at(r, s + 1)});
            if (r < rings - 1) triangles.push_back({at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
        }
    return triangles;
}

/// Closed balls and boxes, an open sheet that is seen from both sides, and things behind the camera.
Scene mixedScene() {
    SmallScene scene;
    scene.part(ball({0, 1, 0}, 0.8, 24), true);
    scene.box({-2, 0, -1}, {-1, 1.3, 0.2});
    scene.quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
    scene.quad({1, 0, -1}, {0, 0, 1.5}, {0.3, 2, 0});  // its back towards the camera
    scene.part(ball({2.1, 0.4, 1}, 0.4, 16), true);
    scene.box({-1, 0, 30}, {1, 1, 31});
    scene.part(ball({40, 0, 0}, 1.0, 16), true);
    scene.camera({3, 2.5, 6}, {0, 0.7, 0});
    return scene.take();
}

class GpuSceneTest : public ContextTest {
 protected:
    void SetUp() override {
        ContextTest::SetUp();
        if (IsSkipped()) return;
        clipFromWorld_ = clipFromWorld(scene_.cameras[0], 1.0);
    }

    FloatImage depthMap(const GpuScene::DepthDraw& draw, DrawCounts* counts = nullptr) {
        const GpuScene gpu(scene_, capabilities());
        const GlTexture map;
        glBindTexture(GL_TEXTURE_2D, map.id());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size, size, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                     nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        const GlFramebuffer framebuffer;
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map.id(), 0);
        const GLenum none = GL_NONE;
        glDrawBuffers(1, &none);
        requireCompleteFramebuffer("the test's depth map");
        glViewport(0, 0, size, size);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_DEPTH_BUFFER_BIT);
        Program program("tests/position.vert", "tests/nothing.frag");
        program.set("uClipFromWorld", glm::mat4(clipFromWorld_));
        program.prepareToDraw();
        const DrawCounts drawn = gpu.drawDepth(draw);
        if (counts) *counts = drawn;
        EXPECT_FALSE(glIsEnabled(GL_CULL_FACE)) << "drawDepth leaves culling disabled";
        FloatImage depth = readDepthTexture(map.id(), {size, size});
        checkGlErrors("drawing a depth map in a test");
        return depth;
    }

    FloatImage shadedPicture(const VisibleClusters& visible, DrawCounts* counts = nullptr,
                             std::vector<std::string> defines = {}) {
        const GpuScene gpu(scene_, capabilities());
        RenderTarget target({size, size}, capabilities());
        target.bind();
        glEnable(GL_DEPTH_TEST);
        glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        Program program("tests/attributes.vert", "tests/material.frag", std::move(defines));
        program.set("uClipFromWorld", glm::mat4(clipFromWorld_));
        const DrawCounts drawn = gpu.drawShaded(program, visible);
        if (counts) *counts = drawn;
        FloatImage image = target.read(4);
        checkGlErrors("drawing a picture in a test");
        return image;
    }

    static std::size_t covered(const FloatImage& depth) {
        std::size_t count = 0;
        for (const float value : depth.values) count += value < 1.0f ? 1 : 0;
        return count;
    }

    static constexpr int size = 192;
    Scene scene_ = mixedScene();
    glm::dmat4 clipFromWorld_{1.0};
};

TEST_P(GpuSceneTest, CullingClosedPartsCoversTheSameAndKeepsTheNearest) {
    const VisibleClusters all = allClusters(scene_);
    DrawCounts counts;
    const FloatImage culled = depthMap({.visible = &all}, &counts);
    EXPECT_EQ(counts.triangles, scene_.triangleCount());
    const FloatImage whole = depthMap({.visible = &all, .cullClosed = false});
    EXPECT_GT(covered(whole), std::size_t(size * size / 4));
    std::size_t different = 0;
    for (std::size_t i = 0; i < whole.values.size(); ++i) {
        ASSERT_EQ(culled.values[i] < 1.0f, whole.values[i] < 1.0f) << "pixel " << i;
        ASSERT_NEAR(culled.values[i], whole.values[i], 6e-7)
            << "10 steps of a float just below 1, at pixel " << i;
        different += culled.values[i] != whole.values[i] ? 1 : 0;
    }
    EXPECT_LE(different, 3u) << "only where front and back meet along a silhouette";
}

TEST_P(GpuSceneTest, CullingWhatIsNotClosedWouldChangeIt) {
    const VisibleClusters all = allClusters(scene_);
    const FloatImage right = depthMap({.visible = &all});
    for (Part& part : scene_.parts) part.closed = true;  // a lie: the sheets are open
    EXPECT_NE(right, depthMap({.visible = &all}));
}

TEST_P(GpuSceneTest, CullingClustersOutsideTheFrustumDoesNotChangeTheDepthMap) {
    const VisibleClusters all = allClusters(scene_);
    const VisibleClusters visible = visibleClusters(scene_, Frustum(clipFromWorld_));
    EXPECT_LT(visible.triangles, all.triangles);
    DrawCounts counts;
    EXPECT_EQ(depthMap({.visible = &all}), depthMap({.visible = &visible}, &counts));
    EXPECT_EQ(counts.triangles, visible.triangles);
}

TEST_P(GpuSceneTest, FrontFacesInsteadIsDeeper) {
    const VisibleClusters all = allClusters(scene_);
    const FloatImage nearest = depthMap({.visible = &all});
    const FloatImage back = depthMap({.visible = &all, .frontFacesInstead = true});
    std::size_t deeper = 0;
    for (std::size_t i = 0; i < nearest.values.size(); ++i) {
        EXPECT_GE(back.values[i], nearest.values[i] - 6e-7f);
        deeper += back.values[i] > nearest.values[i] ? 1 : 0;
    }
    EXPECT_GT(deeper, 1000u);
}

TEST_P(GpuSceneTest, OnePartCanBeLeftOut) {
    const VisibleClusters all = allClusters(scene_);
    DrawCounts counts;
    const FloatImage without = depthMap({.visible = &all, .exceptPart = 2}, &counts);
    EXPECT_EQ(counts.triangles, scene_.triangleCount() - scene_.parts[2].triangleCount);
    EXPECT_LT(covered(without), covered(depthMap({.visible = &all})));
}

TEST_P(GpuSceneTest, DepthAndShadedPassesCoverTheSamePixels) {
    const VisibleClusters all = allClusters(scene_);
    const FloatImage depth = depthMap({.visible = &all});
    DrawCounts counts;
    const FloatImage picture = shadedPicture(all, &counts);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            ASSERT_EQ(picture.at(x, y, 3) > 0.0f, depth.at(x, y) < 1.0f) << x << ' ' << y;
    EXPECT_EQ(counts.triangles, scene_.triangleCount());
}

TEST_P(GpuSceneTest, CullingClustersDoesNotChangeThePicture) {
    const VisibleClusters visible = visibleClusters(scene_, Frustum(clipFromWorld_));
    EXPECT_EQ(shadedPicture(allClusters(scene_)), shadedPicture(visible));
}

TEST_P(GpuSceneTest, EachPartHasItsOwnMaterial) {
    SmallScene small;
    small.quad({-2, -1, 0}, {2, 0, 0}, {0, 2, 0})
        .quad({0, -1, 0}, {2, 0, 0}, {0, 2, 0})
        .flatCamera({0, 0, 3}, {0, 0, 0}, 2.0);
    scene_ = small.take();
    clipFromWorld_ = clipFromWorld(scene_.cameras[0], 1.0);
    Material& right = scene_.materials.emplace_back();
    right.diffuse = {0.25f, 0.5f, 0.75f};
    right.specular = {0.5f, 0.25f, 0.125f};
    right.shininess = 64.0f;
    scene_.parts[1].material = 1;
    const FloatImage picture = shadedPicture(allClusters(scene_));
    EXPECT_EQ(picture.at(size / 4, size / 2, 2), 0.8f);
    EXPECT_EQ(picture.at(3 * size / 4, size / 2, 2), 0.75f);
    const FloatImage gloss = shadedPicture(allClusters(scene_), nullptr, {"SHOW_GLOSS"});
    EXPECT_EQ(gloss.at(size / 4, size / 2, 0), 0.04f);
    EXPECT_EQ(gloss.at(size / 4, size / 2, 3), 30.0f);
    EXPECT_EQ(gloss.at(3 * size / 4, size / 2, 2), 0.125f);
    EXPECT_EQ(gloss.at(3 * size / 4, size / 2, 3), 64.0f);
}

TEST_P(GpuSceneTest, DepthOfAPictureIsFinerThanSixteenBits) {
    SmallScene small;
    small.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})
        .quad({-1, -1, 0.003}, {2, 0, 0}, {0, 2, 0})  // of a range of 1000 m; a 65536th is 15 mm
        .flatCamera({0, 0, 3}, {0, 0, 0}, 2.0);
    scene_ = small.take();
    clipFromWorld_ = clipFromWorld(scene_.cameras[0], 1.0);
    scene_.materials.emplace_back().diffuse = glm::vec3(0.25f);
    scene_.parts[1].material = 1;
    EXPECT_EQ(shadedPicture(allClusters(scene_)).at(size / 2, size / 2, 0), 0.25f) << "the nearer of the two";
}

TEST_P(GpuSceneTest, EmissionLeavesTheFrontOnly) {
    SmallScene small;
    small.quad({-2, -1, 0}, {2, 0, 0}, {0, 2, 0})
        .quad({2, -1, 0}, {-2, 0, 0}, {0, 2, 0})
        .flatCamera({0, 0, 3}, {0, 0, 0}, 2.0);
    scene_ = small.take();
    clipFromWorld_ = clipFromWorld(scene_.cameras[0], 1.0);
    scene_.materials[0].diffuse = {0.5f, 0.5f, 0.5f};
    scene_.materials[0].emission = {4.0f, 2.0f, 1.0f};
    const FloatImage picture = shadedPicture(allClusters(scene_));
    EXPECT_EQ(picture.at(size / 4, size / 2, 0), 4.5f);
    EXPECT_EQ(picture.at(3 * size / 4, size / 2, 0), 0.5f) << "its back";
}

TEST_P(GpuSceneTest, VerticesOfOnePositionAreOneInTheDepthPass) {
    // The six corners of a square, two of which coincide with earlier ones: these must not be asked for.
    const MutatedShaders mutated("tests/position.vert", "vec4(aPosition, 1.0);",
                                 "vec4(gl_VertexID == 3 || gl_VertexID == 4 ? vec3(9.0) : aPosition, 1.0);");
    SmallScene small;
    small.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}).flatCamera({0, 0, 3}, {0, 0, 0}, 2.0);
    scene_ = small.take();
    clipFromWorld_ = clipFromWorld(scene_.cameras[0], 1.0);
    const VisibleClusters all = allClusters(scene_);
    EXPECT_EQ(covered(depthMap({.visible = &all})), std::size_t(size) * size);
}

TEST_P(GpuSceneTest, InstancesAreTheSameTrianglesAgain) {
    const VisibleClusters all = allClusters(scene_);
    DrawCounts once, thrice;
    const FloatImage one = depthMap({.visible = &all}, &once);
    const FloatImage three = depthMap({.visible = &all, .instances = 3}, &thrice);
    EXPECT_EQ(one, three);
    EXPECT_EQ(thrice.triangles, 3 * once.triangles);
}

TEST_P(GpuSceneTest, TrianglesOfAPartAreDrawnAlone) {
    SmallScene small;
    small.quad({-2, -1, 0}, {2, 0, 0}, {0, 2, 0})
        .quad({0, -1, 0}, {2, 0, 0}, {0, 2, 0})
        .flatCamera({0, 0, 3}, {0, 0, 0}, 2.0);
    scene_ = small.take();
    clipFromWorld_ = clipFromWorld(scene_.cameras[0], 1.0);
    const GpuScene gpu(scene_, capabilities());
    RenderTarget target({size, size}, capabilities());
    target.bind();
    glDisable(GL_DEPTH_TEST);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    Program program("tests/attributes.vert", "tests/material.frag");
    program.set("uClipFromWorld", glm::mat4(clipFromWorld_));
    const DrawCounts drawn = gpu.drawShaded(program, 1, {{2, 1}});
    EXPECT_EQ(drawn.triangles, 1u);
    // The lower right half of the right quad, whose diagonal rises from (0, -1) to (2, 1).
    const FloatImage picture = target.read(3);
    EXPECT_EQ(picture.at(3 * size / 4 + 8, size - 8, 0), 0.8f);
    EXPECT_EQ(picture.at(size / 2 + 8, size / 4, 0), 0.0f);
    EXPECT_EQ(picture.at(size / 4, size / 2, 0), 0.0f);
}

TEST_P(GpuSceneTest, TheFirstRowOfATextureIsAtVZeroAndDecoded) {
    SmallScene small;
    small.quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}).flatCamera({0, 0, 3}, {0, 0, 0}, 2.0);
    scene_ = small.take();
    clipFromWorld_ = clipFromWorld(scene_.cameras[0], 1.0);
    for (std::size_t i = 0; i < scene_.positions.size(); ++i)  // glTF: v runs down
        scene_.uvs[i] = {0.5f + 0.5f * scene_.positions[i].x, 0.5f - 0.5f * scene_.positions[i].y};
    Texture texture;
    texture.width = texture.height = 256;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            for (const int value : {y < 128 ? 255 : 0, x < 128 ? 188 : 0, 0, 255})
                texture.rgba.push_back(std::uint8_t(value));
    scene_.textures.push_back(texture);
    scene_.materials[0].diffuseTexture = 0;
    scene_.materials[0].diffuse = glm::vec3(1.0f);
    const FloatImage picture = shadedPicture(allClusters(scene_));
    EXPECT_NEAR(picture.at(size / 4, size / 4, 0), 1.0f, 1e-3) << "top";
    EXPECT_NEAR(picture.at(size / 4, 3 * size / 4, 0), 0.0f, 1e-3) << "bottom";
    EXPECT_NEAR(picture.at(size / 4, size / 4, 1), 0.5029f, 2e-3) << "sRGB 188 is 0.5029 linear";
    EXPECT_NEAR(picture.at(3 * size / 4, size / 4, 1), 0.0f, 1e-3) << "right";
}

TEST_P(GpuSceneTest, WithoutMultiDrawThePictureIsTheSame) {
    VisibleClusters visible = visibleClusters(scene_, Frustum(clipFromWorld_));
    visible.clusters.erase(visible.clusters.begin() + 1);  // a gap: two ranges
    Capabilities less = capabilities();
    less.multiDraw = false;
    DrawCounts counts;
    const auto draw = [&](const Capabilities& can) {
        const GpuScene gpu(scene_, can);
        RenderTarget target({size, size}, can);
        target.bind();
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        Program program("tests/attributes.vert", "tests/material.frag");
        program.set("uClipFromWorld", glm::mat4(clipFromWorld_));
        counts = gpu.drawShaded(program, visible);
        return target.read(4);
    };
    const FloatImage inOneCall = draw(capabilities());
    EXPECT_EQ(counts.drawCalls, capabilities().multiDraw ? 1u : 2u);
    EXPECT_EQ(inOneCall, draw(less));
    EXPECT_EQ(counts.drawCalls, 2u);
}

TEST_P(GpuSceneTest, ASceneWithNothingInItDrawsNothing) {
    scene_ = Scene{};
    scene_.materials.emplace_back();
    const VisibleClusters all = allClusters(scene_);
    EXPECT_EQ(covered(depthMap({.visible = &all})), 0u);
}

INSTANTIATE_TEST_SUITE_P(Backends, GpuSceneTest, allContextKinds(), contextKindName);

class RenderTargetTest : public ContextTest {};

TEST_P(RenderTargetTest, ReadsTopRowFirstInEveryFormat) {
    for (const GLenum format : {GLenum(GL_RGBA32F), GLenum(GL_RGBA16F), GLenum(GL_RGBA8)}) {
        RenderTarget target({3, 2}, capabilities(), format);
        target.bind();
        glClearColor(0.0f, 1.0f, 0.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, 1, 1);  // OpenGL's corner: bottom left
        glClearColor(0.25f, 0.0f, 0.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_SCISSOR_TEST);
        const FloatImage image = target.read(2);
        ASSERT_EQ(image.channels, 2);
        EXPECT_NEAR(image.at(0, 1, 0), 0.25f, 0.002f);
        EXPECT_EQ(image.at(0, 0, 0), 0.0f);
        EXPECT_EQ(image.at(0, 0, 1), 1.0f);
        EXPECT_EQ(image.at(2, 1, 1), 1.0f);
        checkGlErrors("reading back");
    }
}

TEST_P(RenderTargetTest, WithoutFloatColourItFallsBack) {
    EXPECT_EQ(RenderTarget({4, 4}, capabilities()).colorFormat(), GLenum(GL_RGBA32F));
    Capabilities less = capabilities();
    less.floatColorBuffer = false;
    EXPECT_EQ(RenderTarget({4, 4}, less).colorFormat(), GLenum(GL_RGBA16F));
}

TEST_P(RenderTargetTest, ImpossibleSizesAreRefused) {
    for (const glm::ivec2& size : {glm::ivec2(0, 4), glm::ivec2(4, -1), glm::ivec2(4, 1 << 20)}) {
        try {
            const RenderTarget refused(size, capabilities());
            ADD_FAILURE() << size.x << ' ' << size.y;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("allows 1 to "), std::string::npos) << error.what();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, RenderTargetTest, allContextKinds(), contextKindName);

}  // namespace
}  // namespace penumbra
