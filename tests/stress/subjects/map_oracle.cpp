#include "tests/stress/map_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/stress/triangle_soup.h"

namespace penumbra::stress {

MapOracle::MapOracle(const Scene& scene, const LightFrustum& frustum, int mapSize, const DepthErrors& onePass)
    : errors_(onePass), mapSize_(mapSize), orthographic_(frustum.orthographic) {
    const bool reversed = frustum.range == DepthRange::reversed;
    sign_ = reversed ? -1.0 : 1.0, near_ = reversed ? -1.0 : 0.0, far_ = reversed ? 0.0 : 1.0;
    const DrawnOff off{errors_.snap, glm::dvec3(errors_.rounding), orthographic_ ? 1.0 : frustum.near};
    for (const Triangle& t : trianglesIn(scene))
        triangles_.emplace_back(frustum.textureFromWorld(), glm::dvec2(mapSize), t, off);
}

MapOracle::Layer MapOracle::layer(const ProjectedTriangle& triangle, const glm::dvec2& at) const {
    const double z = triangle.depth(at);
    const glm::dvec2 slope = triangle.slope() * double(mapSize_);
    double error =
        texelDepthError(errors_, std::abs(z), triangle.distance(at), orthographic_, slope, mapSize_);
    // To the nearest: half a step of the format, not a whole one.
    error -= 0.5 * (errors_.quantum.x + errors_.quantum.y * std::abs(z));
    // A plane's equation is made of differences of rounded corners over the area: eight roundings of what
    // depth changes by along an edge, times longest edge over height.
    const double change = std::min(1.0, triangle.most() - triangle.least());
    return {sign_ * z, error + 8.0 * 0x1p-24 * change * triangle.slenderness()};
}

double MapOracle::nearestOf(const ProjectedTriangle& triangle) const {
    return std::max(near_, sign_ > 0.0 ? triangle.least() : -triangle.most());
}

StoredDepth MapOracle::stored(const glm::ivec2& texel) const {
    const glm::dvec2 at = glm::dvec2(texel) + 0.5;
    double low = far_, high = far_, nearest = far_, bound = 0.0;
    for (const ProjectedTriangle& triangle : triangles_) {
        const Cover cover = triangle.covers(at);
        if (cover == Cover::no) continue;
        const Layer l = layer(triangle, at);
        if (cover == Cover::maybe || !(l.depth - l.error > near_) || !(l.depth + l.error < far_)) {
            low = std::min(low, std::max(near_, std::min(nearestOf(triangle), l.depth - l.error)));
            continue;
        }
        low = std::min(low, l.depth - l.error);
        high = std::min(high, l.depth + l.error);
        if (l.depth < nearest) nearest = l.depth, bound = l.error;
    }
    const bool sure = low >= nearest - bound && high <= nearest + bound;
    if (sign_ < 0.0) std::swap(low, high);
    return {sign_ * low, sign_ * high, sign_ * nearest, sure};
}

TexelShadow MapOracle::shadow(const glm::ivec2& texel) const {
    const glm::dvec2 at = glm::dvec2(texel) + 0.5;
    const Layer ground = layer(triangles_.front(), at);
    TexelShadow result{true, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 1; i < triangles_.size(); ++i) {
        const Cover cover = triangles_[i].covers(at);
        if (cover == Cover::no) continue;
        const Layer l = layer(triangles_[i], at);
        const bool sure = cover == Cover::yes && l.depth - l.error > near_ && l.depth + l.error < far_;
        const double nearest =
            sure ? l.depth - l.error : std::min(nearestOf(triangles_[i]), l.depth - l.error);
        if (!(nearest > ground.depth + ground.error)) result.open = false;
        if (sure) result.dark = std::min(result.dark, l.depth + l.error);
    }
    return result;
}

}  // namespace penumbra::stress
