#include "chapters/08_accumulation/exact_receiver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "chapters/08_accumulation/texel_blocks.h"
#include "common/scene/light.h"
#include "common/truth/lambert_polygon.h"
#include "common/truth/parallel.h"
#include "common/truth/polygon_light.h"
#include "common/truth/segment_test.h"

namespace penumbra {

namespace {

/// Metres: the farthest that the receiver's numbers go.
double extent(const Receiver& receiver) {
    return glm::length(receiver.corner) + glm::length(receiver.uEdge) + glm::length(receiver.vEdge);
}

/// Irradiance for emission 1 at points of a plane.
class PlaneLight {
 public:
    PlaneLight(const Receiver& receiver, const Light& light) : n_(receiver.normal), light_(light) {
        unit_.direction = light.direction;
        unit_.position = light.position;
        unit_.type = light.type;
        unit_.innerCone = light.innerCone;
        unit_.outerCone = light.outerCone;
        plainly_ = 1e-9 * (glm::length(light.position) + std::sqrt(light.area) + extent(receiver));
        for (const auto& polygon : light.polygons)
            for (const glm::dvec3& p : polygon) isAbove_ = isAbove_ && receiver.height(p) > plainly_;
    }

    double unoccluded(const glm::dvec3& x) const {
        if (light_.type != LightType::area) return fromPoint(x);
        double sum = 0.0;
        for (const auto& polygon : light_.polygons) sum += whole(x, polygon);
        return std::numbers::pi * sum;
    }

    double visible(const glm::dvec3& x, std::span<const Triangle> occluders) const {
        if (light_.type != LightType::area) return seen(x, occluders) ? fromPoint(x) : 0.0;
        double sum = 0.0;
        for (const auto& polygon : light_.polygons) sum += visibleFormFactor(x, n_, polygon, occluders);
        return std::numbers::pi * sum;
    }

 private:
    /// formFactor to the bit, three times as fast where `x` is plainly in front of the light and the light
    /// plainly above the receiver, so that nothing of it has to be cut.
    double whole(const glm::dvec3& x, const std::vector<glm::dvec3>& polygon) const {
        if (!isAbove_ || polygon.size() > Polygon3::capacity / 2 - 1 ||
            glm::dot(light_.direction, x - polygon[0]) < plainly_)
            return formFactor(x, n_, polygon);
        Polygon3 relative;
        for (const glm::dvec3& p : polygon) relative.push(p - x);
        return lambertFormFactor(n_, relative);
    }

    double fromPoint(const glm::dvec3& x) const {
        return facingIrradiance(unit_, x).x * std::max(0.0, glm::dot(n_, directionToLight(unit_, x)));
    }

    bool seen(const glm::dvec3& x, std::span<const Triangle> occluders) const {
        const bool far = light_.type == LightType::directional;
        const Segment toLight = {x, far ? -light_.direction : light_.position, far};
        return std::none_of(occluders.begin(), occluders.end(),
                            [&](const Triangle& t) { return crossTriangle(toLight, t) == Crossing::inside; });
    }

    glm::dvec3 n_;
    const Light& light_;
    Light unit_;            ///< a light without an area, of emission 1
    double plainly_ = 0.0;  ///< metres: far more than rounding
    bool isAbove_ = true;
};

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
                                std::span<const Triangle> occluders, bool cull) {
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
    parallelRows((receiver.texels.y + band - 1) / band, [&](int i) {
        const int rows = std::min(band, receiver.texels.y - i * band);
        if (cull)
            visitBlocks(receiver, light, occluders, {block, 0.0, i * band, rows}, render);
        else
            render({{0, i * band}, {receiver.texels.x, rows}, occluders});
    });
    exact.shadowTexels = shadowTexels;
    exact.triangleTests = triangleTests;
    return exact;
}

}  // namespace penumbra
