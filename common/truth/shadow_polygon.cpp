#include "common/truth/shadow_polygon.h"

#include <cmath>

namespace penumbra {

Polygon2 shadowPolygon(const Triangle& triangle, const glm::dvec3& light, const PlanarReceiver& receiver) {
    const glm::dvec3 n = receiver.normal();
    const auto heightOf = [&](const glm::dvec3& p) { return glm::dot(n, p - receiver.corner); };
    const double lightHeight = heightOf(light);
    Polygon2 shadow;
    if (!(lightHeight > 0.0)) return shadow;

    // The shadow of v is light + (v - light) H / (H - h), with h and H the heights of v and of the light: (U,
    // V, w) with w = H - h.
    const glm::dvec2 lightUv = receiver.uv(light);
    ConvexPolygon<glm::dvec3> homogeneous;
    const Polygon3 above = clip(Polygon3(triangle), heightOf);
    for (const glm::dvec3& v : above.span()) {
        const double h = heightOf(v);
        homogeneous.push({receiver.uv(v) * lightHeight - lightUv * h, lightHeight - h});
    }
    // 0 <= U <= w and 0 <= V <= w: inside the receiver, and with w >= 0 below the light.
    homogeneous = clip(homogeneous, [](const glm::dvec3& p) { return p.x; });
    homogeneous = clip(homogeneous, [](const glm::dvec3& p) { return p.z - p.x; });
    homogeneous = clip(homogeneous, [](const glm::dvec3& p) { return p.y; });
    homogeneous = clip(homogeneous, [](const glm::dvec3& p) { return p.z - p.y; });
    for (const glm::dvec3& p : homogeneous.span())
        if (p.z > 0.0)
            shadow.push(glm::clamp(glm::dvec2(p) / p.z, 0.0, 1.0));  // the division may round beyond 1
    if (shadow.count < 3) shadow.count = 0;
    return shadow;
}

double cellCoverage(const Polygon2& polygon, const glm::dvec2& lower, const glm::dvec2& upper) {
    // Clip the cell by the polygon's edges, not the polygon by the cell: the untouched cell then has exactly
    // its own area.
    const double polygonArea = area(polygon);
    if (polygonArea == 0.0) return 0.0;
    const double winding = polygonArea < 0.0 ? -1.0 : 1.0;
    Polygon2 cell;
    cell.push(lower);
    cell.push({upper.x, lower.y});
    cell.push(upper);
    cell.push({lower.x, upper.y});
    const double whole = area(cell);
    for (int i = 0; i < polygon.count && !cell.empty(); ++i) {
        const glm::dvec2 a = polygon[i];
        const glm::dvec2 along = winding * (polygon[polygon.next(i)] - a);
        cell = clip(cell, [&](const glm::dvec2& p) { return along.x * (p.y - a.y) - along.y * (p.x - a.x); });
    }
    return std::min(1.0, area(cell) / whole);
}

double expectedMisArea(const glm::dvec2& edgeDirection) {
    const glm::dvec2 d = glm::abs(edgeDirection) / glm::length(edgeDirection);
    const double c = std::max(d.x, d.y);
    const double s = std::min(d.x, d.y);
    return c / 4.0 + s * s / (12.0 * c);
}

}  // namespace penumbra
