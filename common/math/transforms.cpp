#include "common/math/transforms.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace penumbra {

namespace {

/// The axis that is least parallel to `direction`.
glm::dvec3 leastParallelAxis(const glm::dvec3& direction) {
    const glm::dvec3 a = glm::abs(direction);
    if (a.x <= a.y && a.x <= a.z) return {1, 0, 0};
    return a.y <= a.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
}

}  // namespace

glm::dmat4 perspective(double verticalFov, double aspect, double near, double far, DepthRange range) {
    // Written in near / far, which is 0 for an infinite far plane: the limit needs no branch of its own.
    const double cotangent = 1.0 / std::tan(0.5 * verticalFov);
    const double ratio = near / far;
    const double scale = 1.0 / (1.0 - ratio);
    glm::dmat4 clipFromView(0.0);
    clipFromView[0][0] = cotangent / aspect;
    clipFromView[1][1] = cotangent;
    clipFromView[2][3] = -1.0;
    if (range == DepthRange::standard) {
        clipFromView[2][2] = -(1.0 + ratio) * scale;
        clipFromView[3][2] = -2.0 * near * scale;
    } else {
        clipFromView[2][2] = ratio * scale;
        clipFromView[3][2] = near * scale;
    }
    return clipFromView;
}

glm::dmat4 orthographic(double left, double right, double bottom, double top, double near, double far,
                        DepthRange range) {
    glm::dmat4 clipFromView(1.0);
    clipFromView[0][0] = 2.0 / (right - left);
    clipFromView[1][1] = 2.0 / (top - bottom);
    clipFromView[3][0] = -(right + left) / (right - left);
    clipFromView[3][1] = -(top + bottom) / (top - bottom);
    if (range == DepthRange::standard) {
        clipFromView[2][2] = -2.0 / (far - near);
        clipFromView[3][2] = -(far + near) / (far - near);
    } else {
        clipFromView[2][2] = 1.0 / (far - near);
        clipFromView[3][2] = far / (far - near);
    }
    return clipFromView;
}

glm::dmat4 viewFromWorld(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up) {
    const glm::dvec3 back = -glm::normalize(forward);
    glm::dvec3 right = glm::cross(up, back);
    // Nearer to parallel than this, the direction of the cross product is mostly rounding, and the matrix
    // would shear.
    constexpr double parallelSine = 1e-6;
    if (!(glm::length(right) > parallelSine * glm::length(up))) {
        right = glm::cross(leastParallelAxis(back), back);
    }
    right = glm::normalize(right);
    const glm::dvec3 newUp = glm::cross(back, right);
    const glm::dmat3 viewFromWorldRotation = glm::transpose(glm::dmat3(right, newUp, back));
    glm::dmat4 result(viewFromWorldRotation);
    result[3] = glm::dvec4(-(viewFromWorldRotation * eye), 1.0);
    return result;
}

glm::dmat4 textureFromClip(DepthRange range) {
    const bool halveDepth = range == DepthRange::standard;
    glm::dmat4 result(1.0);
    result[0][0] = 0.5;
    result[1][1] = 0.5;
    result[2][2] = halveDepth ? 0.5 : 1.0;
    result[3] = glm::dvec4(0.5, 0.5, halveDepth ? 0.5 : 0.0, 1.0);
    return result;
}

glm::dvec2 depthSlope(const glm::dmat4& textureFromWorld, const glm::dvec3& p, const glm::dvec3& n) {
    // A plane is a row vector, so it is carried by the inverse transpose. Taken relative to p it is (n, 0).
    const glm::dmat4 textureFromLocal = glm::translate(textureFromWorld, p);
    const glm::dvec4 plane = glm::inverse(glm::transpose(textureFromLocal)) * glm::dvec4(n, 0.0);
    // Edge-on exactly, plane.z is 0: an axis that the plane contains then gives 0, the other infinity, and
    // never 0/0.
    const auto slope = [&plane](double along) { return along == 0.0 ? 0.0 : -along / plane.z; };
    return {slope(plane.x), slope(plane.y)};
}

}  // namespace penumbra
