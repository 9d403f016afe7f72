#include "chapters/08_accumulation/unoccluded_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "chapters/08_accumulation/plane_light.h"
#include "common/truth/parallel.h"

namespace penumbra {

namespace {

constexpr int tile = 16;  ///< texels
constexpr int nodes = 6;  ///< of them are worked out, along each axis
constexpr int spacing = 3;
static_assert((nodes - 1) * spacing == tile - 1);

using Weights = std::array<std::array<double, nodes>, tile>;
using NodeValues = std::array<std::array<double, nodes>, nodes>;
using TileValues = std::array<std::array<double, tile>, tile>;

/// Lagrange's polynomials through the nodes, at every texel.
Weights lagrangeWeights() {
    Weights weights;
    for (int i = 0; i < tile; ++i)
        for (int k = 0; k < nodes; ++k) {
            double weight = 1.0;
            for (int other = 0; other < nodes; ++other)
                if (other != k) weight *= double(i - spacing * other) / double(spacing * (k - other));
            weights[std::size_t(i)][std::size_t(k)] = weight;
        }
    return weights;
}

TileValues interpolated(const NodeValues& values) {
    static const Weights weights = lagrangeWeights();
    std::array<std::array<double, tile>, nodes> alongRows{};
    for (std::size_t k = 0; k < nodes; ++k)
        for (std::size_t i = 0; i < tile; ++i)
            for (std::size_t m = 0; m < nodes; ++m) alongRows[k][i] += weights[i][m] * values[k][m];
    TileValues result{};
    for (std::size_t j = 0; j < tile; ++j)
        for (std::size_t k = 0; k < nodes; ++k)
            for (std::size_t i = 0; i < tile; ++i) result[j][i] += weights[j][k] * alongRows[k][i];
    return result;
}

class Filler {
 public:
    Filler(const Receiver& receiver, const Light& light, std::vector<float>& texture)
        : receiver_(receiver), lit_(receiver, light), texture_(texture) {}

    /// Writes the rows from `first` on: the others are another band's, perhaps on another thread, and as it
    /// interpolates them differently, who came last would show.
    void fillTile(int column, int row, int first) const {
        NodeValues values;
        for (int k = 0; k < nodes; ++k)
            for (int m = 0; m < nodes; ++m) {
                const double value = at(column + spacing * m, row + spacing * k);
                if (!(value > 0.0))
                    return fillEach(column, first, {tile, row + tile - first});  // the light's plane
                values[std::size_t(k)][std::size_t(m)] = value;
            }
        const TileValues smooth = interpolated(values);
        for (const int j : {1, tile - 2})
            for (const int i : {1, tile - 2}) {
                const double exact = at(column + i, row + j);
                const double off = smooth[std::size_t(j)][std::size_t(i)] - exact;
                if (!(std::abs(off) <= 2e-8 * exact))
                    return fillEach(column, first, {tile, row + tile - first});
            }
        for (int j = first - row; j < tile; ++j)
            for (int i = 0; i < tile; ++i)
                texel(column + i, row + j) = float(smooth[std::size_t(j)][std::size_t(i)]);
    }

    void fillEach(int column, int row, const glm::ivec2& size) const {
        for (int j = row; j < row + size.y; ++j)
            for (int i = column; i < column + size.x; ++i) texel(i, j) = float(at(i, j));
    }

 private:
    double at(int column, int row) const { return lit_.unoccluded(receiver_.texelCentre(column, row)); }
    float& texel(int column, int row) const {
        return texture_[std::size_t(row) * std::size_t(receiver_.texels.x) + std::size_t(column)];
    }

    const Receiver& receiver_;
    PlaneLight lit_;
    std::vector<float>& texture_;
};

}  // namespace

std::vector<float> unoccludedTexture(const Receiver& receiver, const Light& light) {
    const glm::ivec2 texels = receiver.texels;
    std::vector<float> texture(std::size_t(texels.x) * std::size_t(texels.y));
    const Filler filler(receiver, light, texture);
    // A spot light's cone has a kink.
    const bool tiled = light.type == LightType::area && std::min(texels.x, texels.y) >= tile;
    parallelRows((texels.y + tile - 1) / tile, [&](int band) {
        const int row = band * tile;
        if (!tiled) return filler.fillEach(0, row, {texels.x, std::min(tile, texels.y - row)});
        // The last tiles overlap those before them.
        for (int column = 0; column < texels.x; column += tile)
            filler.fillTile(std::min(column, texels.x - tile), std::min(row, texels.y - tile), row);
    });
    return texture;
}

}  // namespace penumbra
