#include "chapters/01_depth_from_light/depth_errors.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

constexpr double roundOff = 0x1p-24;

/// sum_j |m_ij| |x_j| for the largest x in `bounds`: what rounding errors of row i are relative to.
glm::dvec4 magnitudes(const glm::dmat4& matrix, const Aabb& bounds) {
    const glm::dvec3 largest = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    glm::dvec4 sum = glm::abs(matrix[3]);
    for (int column = 0; column < 3; ++column) sum += glm::abs(matrix[column]) * largest[column];
    return sum;
}

double subpixelStep() {
    GLint bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    return std::ldexp(1.0, -std::max(bits, 4));  // both APIs promise at least 4
}

}  // namespace

// [begin:errors]
DepthErrors depthErrors(DepthFormat format, const LightFrustum& frustum, const Aabb& bounds, int operations) {
    DepthErrors errors;
    const bool fixedPoint = format == DepthFormat::fixed16 || format == DepthFormat::fixed24;
    errors.quantum = fixedPoint ? glm::vec2(depthQuantum(format, 1.0), 0.0) : glm::vec2(0.0, 0x1p-23);
    errors.snap = float(0.5 * subpixelStep());

    const glm::dvec4 sizes = magnitudes(frustum.textureFromWorld(), bounds);
    errors.rounding =
        glm::vec3(operations * roundOff * glm::dvec3(std::max(sizes.x, sizes.y), sizes.z, sizes.w));

    // The rasteriser works with z in [0,1]. Standard depth gets there by 0.5 z + 0.5, which rounds at 1 even
    // for small z; then z is a plane equation of three terms.
    const bool standard = frustum.range == DepthRange::standard;
    errors.rasterError = glm::vec2(standard ? 2.0 * roundOff : 0.0, 4.0 * roundOff);
    return errors;
}

double texelDepthError(const DepthErrors& errors, double z, double eyeDepth, bool orthographic,
                       const glm::dvec2& slope, int mapSize) {
    const double q = orthographic ? 1.0 : eyeDepth;
    const double change = std::abs(slope.x) + std::abs(slope.y);
    const double quantum = errors.quantum.x + errors.quantum.y * z;
    const double transform = (errors.rounding.y + z * errors.rounding.z) / q;
    const double interpolation = errors.rasterError.x + errors.rasterError.y * (z + change);
    const double lateral = errors.snap / mapSize + (errors.rounding.x + errors.rounding.z) / q;
    return quantum + transform + interpolation + lateral * change;
}
// [end:errors]

}  // namespace penumbra
