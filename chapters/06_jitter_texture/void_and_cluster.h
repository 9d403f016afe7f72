// An order of the texels of a tile in which neighbours are never close in rank: blue noise.
#pragma once

#include <cstdint>
#include <vector>

namespace penumbra {

/// Ranks 0 .. size^2 - 1, row by row, of a size x size tile that repeats: the texels below any rank are
/// spread evenly over the tile (Ulichney 1993, "The void-and-cluster method for dither array generation",
/// SPIE 1913). The same seed gives the same ranks. Takes a time proportional to size^4: 50 ms at 64.
std::vector<int> blueNoiseRanks(int size, std::uint32_t seed);

}  // namespace penumbra
