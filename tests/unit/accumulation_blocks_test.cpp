// Blocks of texels: every texel in one, the mixed ones found, by a tree that answers as all triangles would.
#include "chapters/08_accumulation/block_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "chapters/08_accumulation/occluder_tree.h"
#include "chapters/08_accumulation/texel_blocks.h"
#include "common/truth/polygon_light.h"
#include "common/truth/segment_test.h"
#include "tests/unit/accumulation_scenes.h"

namespace penumbra {
namespace {

using namespace accumulation_scenes;

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
