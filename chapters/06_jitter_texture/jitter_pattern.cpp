#include "chapters/06_jitter_texture/jitter_pattern.h"

#include <fmt/format.h>

#include "chapters/05_jittered_disk/disk_pattern.h"
#include "chapters/06_jitter_texture/void_and_cluster.h"
#include "common/error.h"
#include "common/math/sampling.h"

namespace penumbra {

namespace {

glm::dvec2 randomPair(std::uint32_t a, std::uint32_t b, std::uint32_t seed) {
    return glm::dvec2(hashSeed(a, 2 * b, seed), hashSeed(a, 2 * b + 1, seed)) * 0x1p-32;
}

/// A shift in [0,1)^2 for each texel, each coordinate in blue noise.
std::vector<glm::dvec2> blueShifts(int size, std::uint32_t seed) {
    const std::vector<int> first = blueNoiseRanks(size, hashSeed(seed, 1));
    const std::vector<int> second = blueNoiseRanks(size, hashSeed(seed, 2));
    std::vector<glm::dvec2> shifts;
    for (std::size_t i = 0; i < first.size(); ++i)
        shifts.push_back((glm::dvec2(first[i], second[i]) + 0.5) / double(first.size()));
    return shifts;
}

}  // namespace

const std::vector<std::string>& jitterOrderNames() {
    static const std::vector<std::string> names{"white", "blue"};
    return names;
}

PolarGrid::PolarGrid(int samples) {
    if (samples < 8 || samples > 256 || samples % 8 != 0)
        throw UsageError(fmt::format(
            "--samples {}: a jitter pattern has 8 to 256 samples, a multiple of 8 (8 sectors)", samples));
    sectors = samples >= 128 && samples % 16 == 0 ? 16 : 8;
    rings = samples / sectors;
}

// [begin:outer-ring-first]
glm::ivec2 PolarGrid::cell(int index) const {
    const int ring = rings - 1 - index / sectors, place = index % sectors;
    // Of sixteen sectors every other one first.
    const int sector = sectors == 16 ? 2 * (place % 8) + place / 8 : place;
    return {sector, ring};
}
// [end:outer-ring-first]

// [begin:columns]
JitterTile::JitterTile(int size, int samples, JitterOrder order, std::uint32_t seed)
    : size_(size), samples_(samples) {
    const PolarGrid grid(samples);
    const std::vector<glm::dvec2> shifts =
        order == JitterOrder::blue ? blueShifts(size, seed) : std::vector<glm::dvec2>{};
    for (int texel = 0; texel < size * size; ++texel) {
        for (int i = 0; i < samples; ++i) {
            const glm::dvec2 inCell =
                order == JitterOrder::blue
                    ? glm::fract(randomPair(std::uint32_t(i), 0, seed) + shifts[std::size_t(texel)])
                    : randomPair(std::uint32_t(i), std::uint32_t(texel) + 1, seed);
            const glm::dvec2 square =
                (glm::dvec2(grid.cell(i)) + inCell) / glm::dvec2(grid.sectors, grid.rings);
            points_.emplace_back(onDisk(DiskMap::polar, square));
        }
    }
}
// [end:columns]

}  // namespace penumbra
