// A different pattern for every pixel of a tile, each of them stratified by itself (Uralsky 2005, GPU Gems 2,
// chapter 17).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

/// How the patterns of neighbouring pixels relate.
enum class JitterOrder {
    white,  ///< not at all: errors are independent, and mottle the picture at all scales
    blue  ///< the random places inside the cells are shared, and shifted by blue noise: errors of neighbours
          ///< compensate
};

/// "white", "blue": in the order of the constants.
const std::vector<std::string>& jitterOrderNames();

/// Of `samples` points: sectors around the disk (8, or 16 from 128 points on) and rings of equal area.
/// samples = sectors * rings. Throws UsageError unless `samples` is a multiple of 8 in [8, 256].
struct PolarGrid {
    int sectors = 8, rings = 8;
    explicit PolarGrid(int samples);
    /// The cell (sector, ring; ring 0 at the centre) of sample `index`. The first `sectors` samples are the
    /// outer ring, eight sectors that surround the disk first: they disagree first when an edge comes near.
    glm::ivec2 cell(int index) const;
};

/// size x size columns of `samples` points of the unit disk.
class JitterTile {
 public:
    JitterTile(int size, int samples, JitterOrder order, std::uint32_t seed);
    int size() const { return size_; }
    int samples() const { return samples_; }
    /// The points of pixel (x, y) of the tile.
    std::span<const glm::vec2> column(int x, int y) const {
        return {&points_[std::size_t(y * size_ + x) * std::size_t(samples_)], std::size_t(samples_)};
    }

 private:
    int size_, samples_;
    std::vector<glm::vec2> points_;
};

}  // namespace penumbra
