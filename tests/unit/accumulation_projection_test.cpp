// Where shadows fall on a texture: the matrix of Heckbert & Herf and what its planes cut off; the blocks of
// texels that anything can shadow.
#include "chapters/08_accumulation/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "chapters/08_accumulation/block_map.h"
#include "chapters/08_accumulation/occluder_tree.h"
#include "chapters/08_accumulation/texel_blocks.h"
#include "common/truth/polygon_light.h"
#include "common/truth/segment_test.h"
#include "common/truth/shadow_polygon.h"
#include "tests/unit/accumulation_scenes.h"

namespace penumbra {
namespace {

using namespace accumulation_scenes;

dvec3 divided(const glm::dvec4& p) {
    return dvec3(p) / p.w;
}

LightPoint pointAbove(Random& random, const Receiver& receiver) {
    return {receiver.at({random.between(-1, 2), random.between(-1, 2)}) +
            random.between(0.1, 3.0) * receiver.normal};
}

LightPoint sunAbove(Random& random, const Receiver& receiver) {
    return {glm::normalize(receiver.normal + 0.5 * random.inBox(1.0)), 1.0, true};
}

/// Is a point kept by the clipper of a GPU that computes in float?
bool keptInFloat(const glm::dmat4& clipFromWorld, const dvec3& p) {
    const glm::vec4 clip = glm::mat4(clipFromWorld) * glm::vec4(glm::vec3(p), 1.0f);
    return -clip.w <= clip.z && clip.z <= clip.w;
}

TEST(AccumulationProjection, CornersFillTheTexture) {
    Random random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        for (const LightPoint& point : {pointAbove(random, receiver), sunAbove(random, receiver)}) {
            const auto projection = projectOnReceiver(receiver, point, 0.1, 5.0);
            ASSERT_TRUE(projection);
            for (int i = 0; i < 4; ++i) {
                const glm::dvec2 uv(i & 1, i >> 1);
                const glm::dvec4 texture = projection->textureFromWorld * glm::dvec4(receiver.at(uv), 1.0);
                const dvec3 clip = divided(projection->clipFromWorld * glm::dvec4(receiver.at(uv), 1.0));
                EXPECT_NEAR(texture.w, 1.0, 1e-12);
                EXPECT_NEAR(texture.z, 1.0, 1e-12);
                for (int k = 0; k < 2; ++k) {
                    EXPECT_NEAR(divided(texture)[k], uv[k], 1e-12);
                    EXPECT_NEAR(clip[k], 2.0 * uv[k] - 1.0, 1e-12);
                }
                EXPECT_GT(clip.z, 1.0);  // the receiver does not shadow itself
            }
        }
    }
}

TEST(AccumulationProjection, WIsTheFractionOfTheWay) {
    Random random(2);
    for (int trial = 0; trial < 2000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const LightPoint light = pointAbove(random, receiver);
        const auto projection = projectOnReceiver(receiver, light, 0.01);
        ASSERT_TRUE(projection);
        const glm::dvec2 uv(random.between(0, 1), random.between(0, 1));
        for (const double t : {-2.0, -0.1, 0.005, 0.02, 0.5, 0.99, 1.5}) {
            const dvec3 p = glm::mix(light.position, receiver.at(uv), t);
            const glm::dvec4 texture = projection->textureFromWorld * glm::dvec4(p, 1.0);
            const glm::dvec4 clip = projection->clipFromWorld * glm::dvec4(p, 1.0);
            EXPECT_NEAR(texture.w, t, 1e-11);
            EXPECT_NEAR(clip.w, t, 1e-11);
            EXPECT_NEAR(texture.x, t * uv.x, 1e-11);
            EXPECT_NEAR(texture.y, t * uv.y, 1e-11);
            EXPECT_NEAR(texture.z / texture.w, 1.0 / t, 1e-7);
            const bool between = t > 0.01 && t < projection->far;
            EXPECT_EQ(-clip.w <= clip.z && clip.z <= clip.w, between) << t;
        }
        const glm::dvec4 atLight = projection->textureFromWorld * glm::dvec4(light.position, 1.0);
        for (const double zero : {atLight.x, atLight.y, atLight.w}) EXPECT_NEAR(zero, 0.0, 1e-11);
    }
}

TEST(AccumulationProjection, FromInfinityWIsOne) {
    Random random(3);
    for (int trial = 0; trial < 2000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const LightPoint sun = sunAbove(random, receiver);
        const auto projection = projectOnReceiver(receiver, sun, 0.01, 2.0);
        ASSERT_TRUE(projection);
        const glm::dvec2 uv(random.between(0, 1), random.between(0, 1));
        const double rise = glm::dot(sun.position, receiver.normal);
        for (const double height : {-0.5, -0.01, 0.01, 1.0, 1.99, 3.0}) {
            const dvec3 p = receiver.at(uv) + height / rise * sun.position;
            const glm::dvec4 texture = projection->textureFromWorld * glm::dvec4(p, 1.0);
            const glm::dvec4 clip = projection->clipFromWorld * glm::dvec4(p, 1.0);
            EXPECT_NEAR(texture.x, uv.x, 1e-11);
            EXPECT_NEAR(texture.y, uv.y, 1e-11);
            EXPECT_EQ(clip.w, 1.0);
            EXPECT_EQ(-1.0 <= clip.z && clip.z <= 1.0, height > 0.0 && height < 2.5) << height;
        }
    }
}

TEST(AccumulationProjection, NoneFromThePlaneOrBelow) {
    Random random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const dvec3 inPlane = receiver.at({random.between(-1, 2), random.between(-1, 2)});
        EXPECT_FALSE(projectOnReceiver(receiver, {inPlane}));
        EXPECT_FALSE(projectOnReceiver(receiver, {inPlane - 0.3 * receiver.normal}));
        EXPECT_TRUE(projectOnReceiver(receiver, {inPlane + 1e-6 * receiver.normal}));
        EXPECT_FALSE(projectOnReceiver(receiver, {glm::normalize(receiver.uEdge), 1.0, true}));
        EXPECT_FALSE(projectOnReceiver(receiver, {-receiver.normal, 1.0, true}));
    }
}

// With far = 1 a third of these points are kept, and the receiver shadows itself in speckles.
TEST(AccumulationProjection, NoReceiverShadowsItselfInFloat) {
    Random random(5);
    double thickest = 0.0;
    for (int trial = 0; trial < 3000; ++trial) {
        Receiver receiver = random.receiver({8, 8});
        receiver.corner += random.between(0.0, 100.0) * random.direction();  // anywhere in a large scene
        const LightPoint light = pointAbove(random, receiver);
        const double near = std::pow(10.0, random.between(-3.0, -0.31));
        const auto projection = projectOnReceiver(receiver, light, near);
        ASSERT_TRUE(projection);
        for (int i = 0; i < 20; ++i) {
            const dvec3 p = receiver.at({random.between(-0.5, 1.5), random.between(-0.5, 1.5)});
            EXPECT_FALSE(keptInFloat(projection->clipFromWorld, p)) << "trial " << trial << " near " << near;
            // and what is a little above it, three times the margin, is there
            const double height = 3.0 * (1.0 - projection->far) * receiver.height(light.position);
            if (height < 0.3 * receiver.height(light.position)) {
                const dvec3 above = glm::mix(p, light.position, height / receiver.height(light.position));
                EXPECT_TRUE(keptInFloat(projection->clipFromWorld, above)) << trial;
            }
            const auto sun = projectOnReceiver(receiver, sunAbove(random, receiver), near, 3.0);
            EXPECT_FALSE(keptInFloat(sun->clipFromWorld, p));
        }
        if (near > 0.4) thickest = std::max(thickest, 1.0 - projection->far);
    }
    EXPECT_LT(thickest, 0.1);
}

TEST(AccumulationProjection, FigureTwoIsCutWithinMicrometres) {
    const auto projection = projectOnReceiver(figureReceiver(512), {{0.1, -0.2, 2.0}}, 0.45);
    ASSERT_TRUE(projection);
    EXPECT_LT((1.0 - projection->far) * 2.0, 2e-5);  // metres above the receiver
    EXPECT_GT(projection->far, 0.99999);
}

/// Area on the texture of what a rasteriser would fill: clipped to the six planes, then divided.
double rasterisedArea(const ReceiverProjection& projection, const Triangle& triangle) {
    ConvexPolygon<glm::dvec4> polygon;
    for (const dvec3& p : triangle) polygon.push(projection.clipFromWorld * glm::dvec4(p, 1.0));
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            polygon = clip(polygon, [&](const glm::dvec4& p) { return p.w + sign * p[axis]; });
    Polygon2 shadow;
    for (const glm::dvec4& p : polygon.span()) shadow.push(0.5 * glm::dvec2(p) / p.w + 0.5);
    return std::abs(area(shadow));
}

// Occluders that cross the receiver, stand behind the light or around it: the same shadow as by exact
// clipping.
TEST(AccumulationProjection, ShadowsAreThoseOfExactClipping) {
    Random random(6);
    int partial = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const dvec3 u = random.between(0.3, 2.0) * random.direction();
        const dvec3 v = random.between(0.3, 2.0) * glm::normalize(glm::cross(u, random.direction()));
        const Receiver receiver = receiverOn(random.inBox(1.0), u, v, {8, 8});
        const LightPoint light = pointAbove(random, receiver);
        const Triangle t =
            random.triangleNear(receiver, areaLight(random.polygon(light.position, -receiver.normal, 0.1)));
        const auto projection = projectOnReceiver(receiver, light, 1e-6);
        ASSERT_TRUE(projection);
        ReceiverProjection exact = *projection;  // the far plane on the receiver, for doubles
        const glm::dmat4 rows = glm::transpose(projection->clipFromWorld);
        const glm::dvec4 w = rows[3];
        exact.clipFromWorld =
            glm::transpose(glm::dmat4(rows[0], rows[1], w * (1.0 + 2e-6) - glm::dvec4(0, 0, 0, 2e-6), w));
        const double expected = std::abs(area(shadowPolygon(t, light.position, {receiver.corner, u, v})));
        EXPECT_NEAR(rasterisedArea(exact, t), expected, 1e-4) << trial;
        partial += expected > 0.0 && expected < 1.0;
    }
    EXPECT_GT(partial, 5000);
}

TEST(AccumulationBlocks, TheTreeAnswersAsItsTriangles) {
    Random random(7);
    int some = 0, none = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Receiver receiver = random.receiver({8, 8});
        const Light light = random.lightNear(receiver);
        const Reach reach(receiver, light);
        if (reach.empty()) continue;
        std::vector<Triangle> triangles;
        const int count = random.below(70);
        for (int i = 0; i < count; ++i) {
            const Triangle t = random.triangleNear(receiver, light);
            // Most miss, so that the one that counts may be anywhere.
            if (reach.misses(t) || random.below(20) == 0) triangles.push_back(t);
        }
        const bool expected = std::any_of(triangles.begin(), triangles.end(),
                                          [&](const Triangle& t) { return !reach.misses(t); });
        EXPECT_EQ(OccluderTree(triangles).reachesInto(reach), expected) << trial;
        ++(expected ? some : none);
    }
    EXPECT_GT(some, 200);
    EXPECT_GT(none, 200);
}

TEST(AccumulationBlocks, BlocksCoverEveryTexelOnce) {
    Random random(5);
    for (int trial = 0; trial < 300; ++trial) {
        const Receiver receiver = random.receiver({1 + random.below(70), 1 + random.below(70)});
        const Light light = random.lightNear(receiver);
        std::vector<Triangle> triangles;
        for (int i = 0; i < 4; ++i) triangles.push_back(random.triangleNear(receiver, light));
        std::vector<int> visits(std::size_t(receiver.texels.x) * std::size_t(receiver.texels.y), 0);
        for (int first = 0; first < receiver.texels.y; first += 16)
            visitBlocks(receiver, light, triangles, {8, first, std::min(16, receiver.texels.y - first)},
                        [&](const TexelBlock& block) {
                            EXPECT_TRUE(block.occluders.empty() || std::max(block.size.x, block.size.y) <= 8);
                            for (int j = 0; j < block.size.y; ++j)
                                for (int i = 0; i < block.size.x; ++i)
                                    ++visits[std::size_t(block.first.y + j) * std::size_t(receiver.texels.x) +
                                             std::size_t(block.first.x + i)];
                        });
        for (const int count : visits) ASSERT_EQ(count, 1);
    }
}

// Whole texels: between the corners of those in unmixed blocks and the light's nothing stands.
TEST(AccumulationBlocks, UnmixedBlocksAreLit) {
    Random random(6);
    int lit = 0, mixedBlocksSeen = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const Receiver receiver = random.receiver({40, 30});
        const Light light = random.lightNear(receiver);
        const std::vector<Triangle> triangles = {random.triangleNear(receiver, light),
                                                 random.triangleNear(receiver, light)};
        const BlockMap map = mixedBlocks(receiver, light, triangles, 8);
        ASSERT_EQ(map.blocks, glm::ivec2(5, 4));
        std::int64_t mixedTexels = 0;
        for (int row = 0; row < 30; ++row)
            for (int column = 0; column < 40; ++column) {
                if (map.isMixed(column, row)) {
                    ++mixedTexels;
                    continue;
                }
                const dvec3 x =
                    receiver.at({(column + random.below(2)) / 40.0, (row + random.below(2)) / 30.0});
                for (const dvec3& corner : light.polygons[0]) {
                    const dvec3 p = glm::mix(corner, light.position, 1e-6);
                    if (receiver.height(p) <= 1e-6 || glm::dot(light.direction, x - p) <= 0.0) continue;
                    ++lit;
                    for (const Triangle& t : triangles)
                        EXPECT_NE(crossTriangle({x, p}, t), Crossing::inside) << trial;
                }
            }
        EXPECT_EQ(mixedTexels, map.mixedTexels);
        mixedBlocksSeen += mixedTexels > 0;
    }
    EXPECT_GT(lit, 100000);
    EXPECT_GT(mixedBlocksSeen, 50);
}

TEST(AccumulationBlocks, TheFiguresMixedTexels) {
    const Triangle t = figureTriangle;
    const Corners light = squareLight().polygons[0];
    const BlockMap map = mixedBlocks(figureReceiver(512), squareLight(), {&t, 1}, 16);
    int shadowed = 0;
    const Receiver floor = figureReceiver(512);
    for (int row = 0; row < 512; ++row)
        for (int column = 0; column < 512; ++column) {
            const dvec3 x = floor.texelCentre(column, row);
            if (visibleFormFactor(x, floor.normal, light, {&t, 1}) == formFactor(x, floor.normal, light))
                continue;
            ++shadowed;
            ASSERT_TRUE(map.isMixed(column, row));
        }
    EXPECT_LT(double(map.mixedTexels), 1.06 * shadowed);  // blocks of 16 lose little
}

}  // namespace
}  // namespace penumbra
