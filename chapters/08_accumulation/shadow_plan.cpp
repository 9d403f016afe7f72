#include "chapters/08_accumulation/shadow_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "chapters/08_accumulation/block_map.h"

namespace penumbra {

namespace {

constexpr int blockTexels = 16;

void appendRectangle(std::vector<glm::vec2>& corners, const glm::ivec2& lower, const glm::ivec2& upper) {
    const glm::vec2 a(lower), c(upper), b(c.x, a.y), d(a.x, c.y);
    for (const glm::vec2& corner : {a, b, c, a, c, d}) corners.push_back(corner);
}

/// Neighbouring blocks of a row become one rectangle.
void appendBlocks(const BlockMap& map, const glm::ivec2& texels, std::vector<glm::vec2>& corners) {
    for (int row = 0; row < map.blocks.y; ++row) {
        const std::uint8_t* mixed = &map.mixed[std::size_t(row) * std::size_t(map.blocks.x)];
        for (int first = 0; first < map.blocks.x; ++first) {
            int end = first;
            while (end < map.blocks.x && mixed[end]) ++end;
            if (end > first)
                appendRectangle(corners, map.blockTexels * glm::ivec2(first, row),
                                glm::min(texels, map.blockTexels * glm::ivec2(end, row + 1)));
            first = end;
        }
    }
}

Aabb boundsOf(const Light& light) {
    Aabb box;
    if (light.type != LightType::area) box.extend(light.position);
    for (const auto& polygon : light.polygons)
        for (const glm::dvec3& p : polygon) box.extend(p);
    return box;
}

/// A light inside a closed surface is hidden by its inside, which culling would leave out.
bool isInsideAClosedPart(const Scene& scene, const Light& light) {
    if (light.type == LightType::directional) return false;
    const Aabb box = boundsOf(light);
    return std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        return part.closed && &part != &scene.parts[0] + light.part &&
               glm::all(glm::lessThanEqual(part.bounds.lower, box.upper)) &&
               glm::all(glm::greaterThanEqual(part.bounds.upper, box.lower));
    });
}

/// Shortest distance in the plane from `p` to the receiver; 0 on it. (u, v) and metres alike.
double distanceTo(const Receiver& receiver, const glm::dvec3& p) {
    const glm::dvec2 uv = receiver.uv(p);
    if (uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0) return 0.0;
    const glm::dvec3 foot = p - receiver.height(p) * receiver.normal;
    const std::array<glm::dvec3, 4> corners = receiver.corners();
    double nearest = glm::length(foot - corners[0]);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = corners[i], edge = corners[(i + 1) % 4] - a;
        const double t = std::clamp(glm::dot(foot - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(foot - a - t * edge));
    }
    return nearest;
}

/// w < 0 everywhere: all is clipped. For points of a light that are too low: each shines so flat that it
/// counts next to nothing, and it shines past everything.
constexpr glm::dmat4 nothingDrawn(glm::dvec4(0.0), glm::dvec4(0.0), glm::dvec4(0.0),
                                  glm::dvec4(0.0, 0.0, 0.0, -1.0));

}  // namespace

std::vector<glm::vec2> wholeTexture(const glm::ivec2& texels) {
    std::vector<glm::vec2> corners;
    appendRectangle(corners, glm::ivec2(0), texels);
    return corners;
}

ShadowPlan planShadows(const Scene& scene, const Receiver& receiver, const Light& light,
                       const std::vector<LightPoint>& points, const Skips& skips) {
    ShadowPlan plan;
    plan.receives = receives(receiver, light);
    if (!plan.receives) return plan;
    plan.occluders = occludersBetween(scene, receiver, light);
    plan.reached = !plan.occluders.reaching.empty() || !skips(receiversUnreached);
    if (!plan.reached) return plan;
    for (const LightPoint& point : points) {
        auto projection = projectOnReceiver(receiver, point, plan.occluders.near, plan.occluders.highest);
        if (!projection) continue;
        if (points.size() > 1 && projection->tooLow) projection->clipFromWorld = nothingDrawn;
        plan.points.push_back(point);
        plan.projections.push_back(*projection);
    }
    plan.cullClosed = !isInsideAClosedPart(scene, light);
    if (!skips(clustersNotBetween)) plan.occluders.clusters = allClusters(scene);
    if (skips(texelsUnreached)) {
        const BlockMap map = mixedBlocks(receiver, light, plan.occluders.reaching, blockTexels);
        appendBlocks(map, receiver.texels, plan.texels);
        plan.texelsInReach = map.mixedTexels;
    } else {
        plan.texels = wholeTexture(receiver.texels);
        plan.texelsInReach = std::int64_t(receiver.texels.x) * receiver.texels.y;
    }
    return plan;
}

PlaneEdges planeEdges(const Receiver& receiver) {
    const glm::dvec3 x = glm::normalize(receiver.uEdge), y = glm::cross(receiver.normal, x);
    return {{glm::length(receiver.uEdge), 0.0}, {glm::dot(receiver.vEdge, x), glm::dot(receiver.vEdge, y)}};
}

PointWeights pointWeights(const Receiver& receiver, const std::vector<LightPoint>& points,
                          const std::vector<bool>& on) {
    const glm::dvec3 x = glm::normalize(receiver.uEdge), y = glm::cross(receiver.normal, x);
    PointWeights weights;
    std::vector<glm::dvec4> exact;
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].atInfinity) {  // one point, and all that counts is whether it is seen
            exact.emplace_back(0.0, 0.0, 1e12, 1.0);
            sum += 1e-24;
            continue;
        }
        const glm::dvec3 d = points[i].position - receiver.corner;
        const double height = receiver.height(points[i].position),
                     across = distanceTo(receiver, points[i].position);
        const double moment = on[i] ? points[i].weight * height : 0.0, r2 = height * height + across * across;
        exact.emplace_back(glm::dot(d, x), glm::dot(d, y), height * height, moment);
        sum += moment / (r2 * r2);
    }
    if (sum > 0.0) weights.scale = 1.0 / sum;
    for (const glm::dvec4& p : exact) weights.values.emplace_back(p.x, p.y, p.z, p.w * weights.scale);
    return weights;
}

glm::vec3 heightInFrontOf(const Light& light, const Receiver& receiver) {
    if (light.type != LightType::area) return {0.0f, 0.0f, 1.0f};
    return {glm::dot(light.direction, receiver.uEdge), glm::dot(light.direction, receiver.vEdge),
            glm::dot(light.direction, receiver.corner - light.position)};
}

}  // namespace penumbra
