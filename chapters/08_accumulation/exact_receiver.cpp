#include "chapters/08_accumulation/exact_receiver.h"

#include <algorithm>
#include <atomic>

#include "chapters/08_accumulation/plane_light.h"
#include "chapters/08_accumulation/texel_blocks.h"

namespace penumbra {

namespace {

template <class ValueOf>
void fill(const Receiver& receiver, const TexelBlock& block, std::vector<double>& values,
          const ValueOf& valueOf) {
    for (int row = block.first.y; row < block.first.y + block.size.y; ++row)
        for (int column = block.first.x; column < block.first.x + block.size.x; ++column)
            values[std::size_t(row) * std::size_t(receiver.texels.x) + std::size_t(column)] =
                valueOf(receiver.texelCentre(column, row));
}

std::vector<double> texture(const Receiver& receiver) {
    return std::vector<double>(std::size_t(receiver.texels.x) * std::size_t(receiver.texels.y));
}

}  // namespace

std::vector<double> unoccludedIrradiance(const Receiver& receiver, const Light& light) {
    const PlaneLight lit(receiver, light);
    std::vector<double> values = texture(receiver);
    parallelRows(receiver.texels.y, [&](int row) {
        fill(receiver, {{0, row}, {receiver.texels.x, 1}, {}}, values,
             [&](const glm::dvec3& x) { return lit.unoccluded(x); });
    });
    return values;
}

ExactIrradiance exactIrradiance(const Receiver& receiver, const Light& light,
                                std::span<const Triangle> occluders, bool cull,
                                const ProgressCallback& progress) {
    // Enough bands for all cores, few enough that each may sort out most triangles at once.
    constexpr int band = 32, block = 8;
    const PlaneLight lit(receiver, light);
    ExactIrradiance exact{texture(receiver)};
    std::atomic<std::int64_t> shadowTexels = 0, triangleTests = 0;
    const auto render = [&](const TexelBlock& texels) {
        const std::int64_t count = std::int64_t(texels.size.x) * texels.size.y;
        if (texels.occluders.empty()) {
            fill(receiver, texels, exact.values, [&](const glm::dvec3& x) { return lit.unoccluded(x); });
            return;
        }
        shadowTexels += count;
        triangleTests += count * std::int64_t(texels.occluders.size());
        fill(receiver, texels, exact.values,
             [&](const glm::dvec3& x) { return lit.visible(x, texels.occluders); });
    };
    const auto renderBand = [&](int i) {
        const int rows = std::min(band, receiver.texels.y - i * band);
        if (cull)
            visitBlocks(receiver, light, occluders, {block, i * band, rows}, render);
        else
            render({{0, i * band}, {receiver.texels.x, rows}, occluders});
    };
    parallelRows((receiver.texels.y + band - 1) / band, renderBand, progress);
    exact.shadowTexels = shadowTexels;
    exact.triangleTests = triangleTests;
    return exact;
}

}  // namespace penumbra
