// Which blocks of a receiver's texels anything may shadow.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "chapters/08_accumulation/receiver.h"
#include "common/truth/cone_subtraction.h"

namespace penumbra {

/// Blocks of texels that something may shadow, and those that are lit from the closed form alone.
struct BlockMap {
    int blockTexels = 16;             ///< edge of a block
    glm::ivec2 blocks{0};             ///< the last ones of a row and a column may be narrower
    std::vector<std::uint8_t> mixed;  ///< per block, row 0 at v = 0; 0: every texel sees the whole light
    std::int64_t mixedTexels = 0;

    bool isMixed(int column, int row) const {
        return mixed[std::size_t(row / blockTexels) * std::size_t(blocks.x) +
                     std::size_t(column / blockTexels)] != 0;
    }
};

/// Tests whole texels, not their centres: half a texel of margin, since a rasteriser moves corners by up to
/// 1/256 of one.
BlockMap mixedBlocks(const Receiver& receiver, const Light& light, std::span<const Triangle> occluders,
                     int blockTexels);

}  // namespace penumbra
