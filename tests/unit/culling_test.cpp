// What is culled can't be seen; what can be seen is not culled.
#include "common/scene/culling.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "common/scene/camera.h"

namespace penumbra {
namespace {

Camera randomCamera(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Camera camera;
    camera.position = 5.0 * glm::dvec3(uniform(random), uniform(random), uniform(random));
    camera.forward = glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)) + 1e-3);
    camera.orthographic = uniform(random) > 0.0;
    camera.verticalFov = 0.9 + 0.7 * uniform(random);
    camera.height = 3.0;
    camera.near = 0.1;
    camera.far = 12.0;
    return camera;
}

bool isInside(const glm::dvec4& c, DepthRange range) {
    const double low = range == DepthRange::standard ? -c.w : 0.0;
    return c.w > 0.0 && std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= low && c.z <= c.w;
}

TEST(Culling, ABoxWithAVisiblePointIsNeverDropped) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int visible = 0, dropped = 0;
    for (int i = 0; i < 200000; ++i) {
        const DepthRange range = i % 2 == 0 ? DepthRange::standard : DepthRange::reversed;
        const Camera camera = randomCamera(random);
        const glm::dmat4 clip = clipFromView(camera, 1.4, range) * viewFromWorld(camera);
        Aabb box;
        const glm::dvec3 p(10.0 * uniform(random), 10.0 * uniform(random), 10.0 * uniform(random));
        box.extend(p);
        box.extend(p + glm::dvec3(uniform(random), uniform(random), uniform(random)));
        const bool mayTouch = Frustum(clip, range).mayTouch(box);
        dropped += mayTouch ? 0 : 1;
        if (!isInside(clip * glm::dvec4(p, 1.0), range)) continue;
        ++visible;
        EXPECT_TRUE(mayTouch);
    }
    EXPECT_GT(visible, 1000);
    EXPECT_GT(dropped, 100000) << "and it does drop";
}

TEST(Culling, ABoxBehindOrBesideIsDropped) {
    Camera camera;
    camera.position = {0, 0, 0};
    camera.near = 1.0;
    camera.far = 10.0;
    const auto boxAt = [](const glm::dvec3& p) { return Aabb{p - 0.1, p + 0.1}; };
    for (const DepthRange range : {DepthRange::standard, DepthRange::reversed}) {
        const Frustum frustum(clipFromView(camera, 1.0, range) * viewFromWorld(camera), range);
        EXPECT_TRUE(frustum.mayTouch(boxAt({0, 0, -5})));
        EXPECT_FALSE(frustum.mayTouch(boxAt({0, 0, 5})));
        EXPECT_FALSE(frustum.mayTouch(boxAt({0, 0, -0.5}))) << "in front of near";
        EXPECT_FALSE(frustum.mayTouch(boxAt({0, 0, -11}))) << "behind far";
        EXPECT_FALSE(frustum.mayTouch(boxAt({5, 0, -5})));
        EXPECT_FALSE(frustum.mayTouch(boxAt({0, -5, -5})));
        EXPECT_FALSE(frustum.mayTouch(Aabb())) << "nothing";
    }
}

TEST(Culling, NoFarPlaneDropsNothingFarAway) {
    Camera camera;
    camera.position = {0, 0, 0};
    camera.far = std::numeric_limits<double>::infinity();
    for (const DepthRange range : {DepthRange::standard, DepthRange::reversed}) {
        const Frustum frustum(clipFromView(camera, 1.0, range) * viewFromWorld(camera), range);
        EXPECT_TRUE(frustum.mayTouch({{-1, -1, -1e9}, {1, 1, -1e9}}));
        EXPECT_FALSE(frustum.mayTouch({{-1, -1, 1e9}, {1, 1, 1e9}}));
    }
}

TEST(Culling, TheMarginIsAMillionth) {
    const Frustum frustum(orthographic(-1, 1, -1, 1, -1, 1));
    const auto beyond = [](double gap) { return Aabb{glm::dvec3(1 + gap, 0, 0), glm::dvec3(2, 0.5, 0.5)}; };
    EXPECT_TRUE(frustum.mayTouch(beyond(1e-7))) << "floats in a shader may see it inside";
    EXPECT_FALSE(frustum.mayTouch(beyond(1e-5)));
}

/// Three parts along X, of two, one and two clusters; cluster i has i + 1 triangles.
Scene rowOfClusters() {
    Scene scene;
    const std::uint32_t partOf[] = {0, 0, 1, 2, 2};
    for (std::uint32_t i = 0, first = 0; i < 5; first += ++i) {
        const Aabb box{glm::dvec3(2.0 * i, 0, 0), glm::dvec3(2.0 * i + 1, 1, 1)};
        scene.clusters.push_back({first, i + 1, partOf[i], box});
        if (scene.parts.size() <= partOf[i]) scene.parts.push_back({"part", first, 0, 0, {}, false});
        scene.parts.back().triangleCount += i + 1;
        scene.parts.back().bounds.extend(box);
        scene.indices.resize(scene.indices.size() + 3 * (i + 1));
    }
    return scene;
}

/// Sees x from `left` to `right`.
Frustum slab(double left, double right) {
    return Frustum(orthographic(left, right, -10, 10, -10, 10));
}

TEST(Culling, VisibleClustersAreThoseOfTheFrustum) {
    const Scene scene = rowOfClusters();
    EXPECT_EQ(visibleClusters(scene, slab(-1, 20)), allClusters(scene));
    EXPECT_EQ(allClusters(scene).triangles, 15u);
    const VisibleClusters some = visibleClusters(scene, slab(2.5, 6.5));
    EXPECT_EQ(some.clusters, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(some.triangles, 9u);
    const VisibleClusters last = visibleClusters(scene, slab(3.5, 20));
    EXPECT_EQ(last.clusters, (std::vector<std::uint32_t>{2, 3, 4}))
        << "a part left out takes no other with it";
    EXPECT_TRUE(visibleClusters(scene, slab(50, 60)).clusters.empty());
}

TEST(Culling, NeighboursAreJoinedIntoOneDrawCall) {
    const Scene scene = rowOfClusters();
    const auto everything = [](std::uint32_t) { return true; };
    const auto ranges = joinRanges(scene, allClusters(scene), everything);
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].triangleCount, 15u);
    const auto withoutMiddle =
        joinRanges(scene, allClusters(scene), [](std::uint32_t part) { return part != 1; });
    ASSERT_EQ(withoutMiddle.size(), 2u);
    EXPECT_EQ(withoutMiddle[0].triangleCount, 3u);
    EXPECT_EQ(withoutMiddle[1].firstTriangle, 6u);
    EXPECT_EQ(withoutMiddle[1].triangleCount, 9u);
}

}  // namespace
}  // namespace penumbra
