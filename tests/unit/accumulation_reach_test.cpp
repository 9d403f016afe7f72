// What is left out between a light and a receiver must never matter, and enough must be left out.
#include "chapters/08_accumulation/reach.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "chapters/08_accumulation/projection.h"
#include "common/truth/polygon_light.h"
#include "common/truth/segment_test.h"
#include "tests/unit/accumulation_scenes.h"

namespace penumbra {
namespace {

using namespace accumulation_scenes;

std::array<dvec3, 3> pointsOn(const Receiver& receiver, Random& random) {
    return {receiver.at({random.below(2), random.below(2)}),
            receiver.at({random.between(0, 1), random.between(0, 1)}),
            receiver.at({random.between(0, 1), double(random.below(2))})};
}

double visible(const dvec3& x, const Receiver& receiver, const Light& light, const Triangle& t) {
    return visibleFormFactor(x, receiver.normal, light.polygons[0], {&t, 1});
}

/// Does nothing but touch the plane from below, up to rounding, and so counts as in it.
bool onlyTouches(const Receiver& receiver, const Triangle& t) {
    return std::max({receiver.height(t[0]), receiver.height(t[1]), receiver.height(t[2])}) < 1e-9;
}

double whole(const dvec3& x, const Receiver& receiver, const Light& light) {
    return formFactor(x, receiver.normal, light.polygons[0]);
}

TEST(AccumulationReach, WhatMissesNeverShadows) {
    Random random(1);
    int missed = 0, shadows = 0, needless = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const Light light = random.lightNear(receiver);
        const Triangle t = random.triangleNear(receiver, light);
        const Reach reach(receiver, light);
        const bool misses = reach.empty() || reach.misses(t);
        const auto isShadowed = [&](const dvec3& x) {
            const double all = whole(x, receiver, light);
            EXPECT_TRUE(all == 0.0 || !reach.empty());
            return visible(x, receiver, light, t) != all && !onlyTouches(receiver, t);
        };
        bool any = false;
        for (const dvec3& x : pointsOn(receiver, random)) {
            const bool changes = isShadowed(x);
            any = any || changes;
            EXPECT_FALSE(misses && changes) << trial;
        }
        missed += misses;
        shadows += any;
        if (misses || any) continue;
        for (int i = 0; i < 64 && !any; ++i) any = isShadowed(receiver.at(glm::dvec2(i % 8, i >> 3) / 7.0));
        needless += !any;
    }
    EXPECT_GT(missed, 20000);         // it culls
    EXPECT_GT(shadows, 20000);        // there was something it had to keep
    EXPECT_LT(5 * needless, missed);  // and of what could go, most goes
    RecordProperty("missed", missed);
    RecordProperty("needless", needless);
}

TEST(AccumulationReach, ABoxThatMissesHoldsNothingThatShadows) {
    Random random(2);
    int missed = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const Light light = random.lightNear(receiver);
        const Triangle t = random.triangleNear(receiver, light);
        Aabb box;
        for (const dvec3& p : t) box.extend(p);
        const Reach reach(receiver, light);
        if (!reach.empty() && !reach.misses(box)) continue;
        ++missed;
        EXPECT_TRUE(reach.empty() || reach.misses(t));
        if (onlyTouches(receiver, t)) continue;
        for (const dvec3& x : pointsOn(receiver, random))
            EXPECT_EQ(visible(x, receiver, light, t), whole(x, receiver, light)) << trial;
    }
    EXPECT_GT(missed, 10000);
}

TEST(AccumulationReach, EmptyWhereNoLightArrives) {
    const Receiver floor = figureReceiver(8);
    EXPECT_FALSE(Reach(floor, squareLight()).empty());
    Light below = areaLight({{-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {1, -1, -1}});
    EXPECT_TRUE(Reach(floor, below).empty());
    const Light away = areaLight({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}});
    EXPECT_TRUE(Reach(floor, away).empty());
    // A wall light, half below the horizon: it arrives.
    EXPECT_FALSE(Reach(floor, areaLight({{2, -1, -1}, {2, -1, 1}, {2, 1, 1}, {2, 1, -1}})).empty());
    Light lamp;
    lamp.type = LightType::point;
    lamp.position = {0, 0, -1};
    EXPECT_TRUE(Reach(floor, lamp).empty());
    Light sun;
    sun.direction = {0, 0, 1};
    EXPECT_TRUE(Reach(floor, sun).empty());
}

TEST(AccumulationReach, LightsWithoutAnArea) {
    Random random(3);
    int missed = 0, shadows = 0;
    for (int trial = 0; trial < 100000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const bool far = random.below(2) == 0;
        Light light;
        light.type = far ? LightType::directional : LightType::point;
        light.position = receiver.at({random.between(-1, 2), random.between(-1, 2)}) +
                         random.between(0.05, 2.0) * receiver.normal;
        light.direction = -glm::normalize(receiver.normal + 0.5 * random.inBox(1.0));
        const Triangle t = random.triangleNear(receiver, light);
        const Reach reach(receiver, light);
        const bool misses = reach.misses(t);
        missed += misses;
        for (const dvec3& x : pointsOn(receiver, random)) {
            const Segment segment = {x, far ? -light.direction : light.position, far};
            const bool hit = crossTriangle(segment, t) == Crossing::inside;
            shadows += hit;
            EXPECT_FALSE(misses && hit) << trial << (far ? " sun" : " lamp");
        }
    }
    EXPECT_GT(missed, 20000);
    EXPECT_GT(shadows, 5000);
}

TEST(AccumulationReach, SeveralPolygonsAreOneLight) {
    // Two halves; a triangle under each shadows its side only, but misses neither the whole light.
    Light light = areaLight({{-2, -1, 2}, {-2, 1, 2}, {-1, 1, 2}, {-1, -1, 2}});
    light.polygons.push_back({{1, -1, 2}, {1, 1, 2}, {2, 1, 2}, {2, -1, 2}});
    const Receiver floor = receiverOn({-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0}, {4, 4});
    const Reach reach(floor, light);
    const Triangle left = {dvec3(-0.8, 0, 1), dvec3(-0.7, 0, 1), dvec3(-0.75, 0.1, 1)};
    const Triangle right = {dvec3(0.8, 0, 1), dvec3(0.7, 0, 1), dvec3(0.75, 0.1, 1)};
    const Triangle between = {dvec3(-0.1, 0, 1), dvec3(0.1, 0, 1), dvec3(0, 0.1, 1)};
    EXPECT_FALSE(reach.misses(left));
    EXPECT_FALSE(reach.misses(right));
    EXPECT_TRUE(reach.misses(between));  // it does shadow points between the two, if there were light
}

Scene figureScene() {
    Scene scene = test_meshes::emptyScene();
    scene.lights = {squareLight()};
    addTriangles(scene, {figureTriangle});
    return scene;
}

TEST(AccumulationReach, OccludersOfTheFigure) {
    Scene scene = figureScene();
    addTriangles(scene, {{dvec3(-1, -1, 0), dvec3(1, -1, 0), dvec3(1, 1, 0)}});     // in the plane
    addTriangles(scene, {{dvec3(-1, -1, 3), dvec3(1, -1, 3), dvec3(1, 1, 3)}});     // behind the light
    addTriangles(scene, {{dvec3(-1, -1, -1), dvec3(1, -1, -1), dvec3(1, 1, -1)}});  // below
    addTriangles(scene, {{dvec3(3, -1, 1), dvec3(4, -1, 1), dvec3(4, 1, 1)}});      // beside
    addClusters(scene);
    const Occluders occluders = occludersBetween(scene, figureReceiver(64), scene.lights[0]);
    EXPECT_EQ(occluders.clusters.clusters, std::vector<std::uint32_t>{0});
    EXPECT_EQ(occluders.clusters.triangles, 1u);
    ASSERT_EQ(occluders.reaching.size(), 1u);
    EXPECT_NEAR(occluders.highest, 1.0, 1e-15);
    EXPECT_NEAR(occluders.near, 0.45, 1e-12);  // the triangle is halfway
    scene.lights[0].part = 0;
    EXPECT_TRUE(occludersBetween(scene, figureReceiver(64), scene.lights[0]).reaching.empty());
}

TEST(AccumulationReach, NearestFractionIsBeforeEveryOccluder) {
    Random random(4);
    int beyondTheFloor = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const Light light = random.lightNear(receiver);
        Scene scene = test_meshes::emptyScene();
        for (int i = 0; i < 3; ++i) addTriangles(scene, {random.triangleNear(receiver, light)});
        addClusters(scene);
        const Occluders occluders = occludersBetween(scene, receiver, light);
        EXPECT_GE(occluders.near, nearestFraction);
        EXPECT_LE(occluders.near, 0.5);
        if (occluders.near == nearestFraction) continue;  // something is as high as the light
        ++beyondTheFloor;
        for (const Triangle& t : occluders.reaching)
            for (const dvec3& p : t)
                for (const dvec3& a : light.polygons[0])
                    EXPECT_GT(1.0 - receiver.height(p) / receiver.height(a), occluders.near);
    }
    EXPECT_GT(beyondTheFloor, 200);
}

TEST(AccumulationReach, AReceiversOwnTrianglesNeverShadowIt) {
    // A tilted floor of floats is off its own plane by their rounding.
    Scene scene = test_meshes::emptyScene();
    scene.lights = {squareLight()};
    std::vector<Triangle> triangles;
    const auto at = [](int i, int j) { return dvec3(0.1 * i, 0.1 * j, 0.037 * i - 0.013 * j); };
    for (int j = -8; j < 8; ++j)
        for (int i = -8; i < 8; ++i) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    addTriangles(scene, triangles);
    addClusters(scene);
    const std::vector<Receiver> receivers = findReceivers(scene, {});
    ASSERT_EQ(receivers.size(), 1u);
    EXPECT_EQ(receivers[0].triangles.size(), triangles.size());
    EXPECT_TRUE(occludersBetween(scene, receivers[0], scene.lights[0]).reaching.empty());
    Receiver stranger = receivers[0];  // were they of another part, they would still lie in its plane
    stranger.triangles.clear();
    EXPECT_TRUE(occludersBetween(scene, stranger, scene.lights[0]).reaching.empty());
}

}  // namespace
}  // namespace penumbra
