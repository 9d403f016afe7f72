#include "common/truth/segment_test.h"

#include <cmath>

#include "common/truth/light_pyramid.h"

namespace penumbra {

namespace {

/// Sum of |products| in cross(a, b): what its rounding error is relative to.
glm::dvec3 crossMagnitude(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 p = glm::abs(a), q = glm::abs(b);
    return {p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x};
}

/// Which side of the plane, -1 or 1; 0 if rounding could decide. The bound counts the roundings (Higham 2002,
/// section 3.1): 2 in the differences of vertices, 2 in the cross product, 1 in p - a, 3 in the dot product,
/// and 4 with which a point interpolated on a triangle can be off itself, each at most 2^-53 of the
/// magnitudes; 16 covers their sum.
int side(const glm::dvec3& n, const glm::dvec3& nMagnitude, const glm::dvec3& fromPlane,
         const glm::dvec3& magnitude) {
    const double distance = glm::dot(n, fromPlane);
    const double bound = 16.0 * 0x1p-53 * glm::dot(nMagnitude, magnitude);
    return distance > bound ? 1 : distance < -bound ? -1 : 0;
}

}  // namespace

Crossing crossTriangle(const Segment& segment, const std::array<glm::dvec3, 3>& triangle) {
    const glm::dvec3 &a = triangle[0], &b = triangle[1], &c = triangle[2];
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const glm::dvec3 nMagnitude = crossMagnitude(b - a, c - a);
    const auto sideOfPoint = [&](const glm::dvec3& p) {
        return side(n, nMagnitude, p - a, glm::abs(p) + glm::abs(a));
    };
    const int start = sideOfPoint(segment.origin);
    if (start == 0) return Crossing::none;
    const int end = segment.towardsInfinity ? side(n, nMagnitude, segment.target, glm::abs(segment.target))
                                            : sideOfPoint(segment.target);
    if (start * end >= 0) return Crossing::none;

    // Volumes spanned with the three edges (Plücker): all of one sign means inside. Each is computed from the
    // edge's ends alone, and with the opposite sign for the opposite direction, so neighbours agree on their
    // common edge. Not from cross(pb, pc), which loses the digits of a short edge far away: a triangle of a
    // micrometre would be hit or missed by a tenth of a nanometre from a metre away.
    const glm::dvec3 d = segment.direction();
    const glm::dvec3 pa = a - segment.origin, pb = b - segment.origin, pc = c - segment.origin;
    const double u = glm::dot(d, edgePlane(pb, pc));
    const double v = glm::dot(d, edgePlane(pc, pa));
    const double w = glm::dot(d, edgePlane(pa, pb));
    const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    return inside ? Crossing::inside : Crossing::missed;
}

}  // namespace penumbra
