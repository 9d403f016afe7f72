#include "common/math/polygon.h"

#include "common/error.h"

namespace penumbra {

void throwPolygonOverflow() {
    throw Error("polygon: more than 24 vertices; split the polygon into smaller convex ones first");
}

double area(const Polygon2& polygon) {
    double twice = 0.0;
    for (int i = 1; i + 1 < polygon.count; ++i) {
        const glm::dvec2 a = polygon[i] - polygon[0];
        const glm::dvec2 b = polygon[i + 1] - polygon[0];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

glm::dvec3 areaNormal(std::span<const glm::dvec3> polygon) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum;
}

}  // namespace penumbra
