#include "chapters/08_accumulation/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/magnitude.h"

namespace penumbra {

namespace {

constexpr double floatRounding = 0x1p-24;  ///< relative, of one float operation

/// A plane function p -> dot(normal, p) + offset, as one row of a matrix.
glm::dvec4 row(const glm::dvec3& normal, const glm::dvec3& zeroAt) {
    return {normal, -glm::dot(normal, zeroAt)};
}

glm::dmat4 fromRows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& w) {
    return glm::transpose(glm::dmat4(x, y, z, w));
}

/// Largest sum of the magnitudes that add up to `row` at a corner of the receiver: what its rounding is
/// proportional to.
double magnitude(const Receiver& receiver, const glm::dvec4& row) {
    double largest = 0.0;
    for (const glm::dvec3& p : receiver.corners())
        largest = std::max(largest, sumOfMagnitudes(glm::dvec3(row) * p) + std::abs(row.w));
    return largest;
}

/// How far floats may lie from the plane they should lie in, metres.
double flatness(const Receiver& receiver) {
    double largest = 0.0;
    for (const glm::dvec3& p : receiver.corners()) largest = std::max(largest, sumOfMagnitudes(p));
    return 2.0 * floatRounding * largest;
}

/// A shader's sum of four products of rounded numbers: 5 roundings of each, and twice that to be safe, since
/// a coplanar polygon of another part may reach beyond the receiver.
constexpr double roundingsOfARow = 10.0;

/// From a point: every plane goes through it, and the matrix is homogeneous.
ReceiverProjection fromPoint(const Receiver& receiver, const glm::dvec3& light, double near) {
    // [begin:heckbert-herf]
    const glm::dvec3 fromLight = receiver.corner - light;
    const glm::dvec3 uNormal = glm::cross(fromLight, receiver.vEdge);
    const glm::dvec3 vNormal = glm::cross(receiver.uEdge, fromLight);
    const glm::dvec3 tNormal = glm::cross(receiver.vEdge, receiver.uEdge);
    const glm::dvec4 u = row(uNormal / glm::dot(uNormal, receiver.uEdge), receiver.corner);
    const glm::dvec4 v = row(vNormal / glm::dot(vNormal, receiver.vEdge), receiver.corner);
    const glm::dvec4 t = row(tNormal / glm::dot(tNormal, fromLight), light);
    // [end:heckbert-herf]

    // [begin:far]
    // The far plane lets t pass when w - z = 2 near (1 - t) > 0, and w and z are rounded before.
    const double rounding = roundingsOfARow * floatRounding * 2.0 * magnitude(receiver, t);
    const double above = rounding / (2.0 * near) + flatness(receiver) / receiver.height(light);
    // [end:far]
    ReceiverProjection projection;
    projection.near = near;
    const double halfWay = 0.5 * (1.0 + near);
    projection.tooLow = 1.0 - above <= halfWay;
    projection.far = std::max(1.0 - above, halfWay);
    const double depth = projection.far - near;
    const glm::dvec4 z = t * ((projection.far + near) / depth) -
                         glm::dvec4(0.0, 0.0, 0.0, 2.0 * projection.far * near / depth);
    projection.textureFromWorld = fromRows(u, v, {0.0, 0.0, 0.0, 1.0}, t);
    projection.clipFromWorld = fromRows(2.0 * u - t, 2.0 * v - t, z, t);
    return projection;
}

/// From infinitely far: the planes are parallel to the direction, and w is 1.
ReceiverProjection fromInfinity(const Receiver& receiver, const glm::dvec3& toLight, double highest) {
    const glm::dvec3 uNormal = glm::cross(receiver.vEdge, toLight);
    const glm::dvec3 vNormal = glm::cross(toLight, receiver.uEdge);
    const glm::dvec4 u = row(uNormal / glm::dot(uNormal, receiver.uEdge), receiver.corner);
    const glm::dvec4 v = row(vNormal / glm::dot(vNormal, receiver.vEdge), receiver.corner);
    const glm::dvec4 height = row(receiver.normal, receiver.corner);
    const glm::dvec4 one(0.0, 0.0, 0.0, 1.0);
    const double lowest = roundingsOfARow * floatRounding * magnitude(receiver, height) + flatness(receiver);
    const double top = std::max(1.01 * highest, 2.0 * lowest);
    ReceiverProjection projection;
    projection.textureFromWorld = fromRows(u, v, one - height, one);
    const glm::dvec4 z = one - (height - lowest * one) * (2.0 / (top - lowest));
    projection.clipFromWorld = fromRows(2.0 * u - one, 2.0 * v - one, z, one);
    return projection;
}

}  // namespace

std::optional<ReceiverProjection> projectOnReceiver(const Receiver& receiver, const LightPoint& point,
                                                    double near, double highestOccluder) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    if (point.atInfinity) {
        if (glm::dot(receiver.normal, point.position) <= 8.0 * epsilon) return std::nullopt;
        return fromInfinity(receiver, point.position, highestOccluder);
    }
    const double rounding =
        8.0 * epsilon * (sumOfMagnitudes(point.position) + sumOfMagnitudes(receiver.corner));
    if (receiver.height(point.position) <= rounding) return std::nullopt;
    return fromPoint(receiver, point.position, near);
}

}  // namespace penumbra
