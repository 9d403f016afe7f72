#include "chapters/08_accumulation/block_map.h"

#include <atomic>

#include "chapters/08_accumulation/occluder_tree.h"
#include "chapters/08_accumulation/reach.h"
#include "chapters/08_accumulation/texel_blocks.h"
#include "common/truth/parallel.h"

namespace penumbra {

BlockMap mixedBlocks(const Receiver& receiver, const Light& light, std::span<const Triangle> occluders,
                     int blockTexels) {
    BlockMap map;
    map.blockTexels = blockTexels;
    map.blocks = (receiver.texels + blockTexels - 1) / blockTexels;
    map.mixed.assign(std::size_t(map.blocks.x) * std::size_t(map.blocks.y), 0);
    const OccluderTree tree(occluders);
    std::atomic<std::int64_t> mixedTexels = 0;
    parallelRows(map.blocks.y, [&](int row) {
        for (int column = 0; column < map.blocks.x; ++column) {
            const glm::ivec2 first = blockTexels * glm::ivec2(column, row);
            const glm::ivec2 size = glm::min(glm::ivec2(blockTexels), receiver.texels - first);
            const Reach reach(texelCorners(receiver, first, size, 0.5), receiver.normal, light);
            if (reach.empty() || !tree.reachesInto(reach)) continue;
            map.mixed[std::size_t(row) * std::size_t(map.blocks.x) + std::size_t(column)] = 1;
            mixedTexels += std::int64_t(size.x) * size.y;
        }
    });
    map.mixedTexels = mixedTexels;
    return map;
}

}  // namespace penumbra
