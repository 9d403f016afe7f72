#include "chapters/03_polygon_offset/depth_bias.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

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

/// Change of window depth for a metre at `eyeDepth`.
double depthPerMetre(const LightFrustum& frustum, double eyeDepth) {
    if (frustum.orthographic) return 1.0 / (frustum.far - frustum.near);
    return frustum.far * frustum.near / ((frustum.far - frustum.near) * eyeDepth * eyeDepth);
}

}  // namespace

const std::vector<std::string>& biasMethodNames() {
    static const std::vector<std::string> names{"none",       "constant",       "polygon-offset",
                                                "slope",      "receiver-plane", "normal-offset",
                                                "front-face", "midpoint"};
    return names;
}

BiasMethod biasMethod(const std::string& name) {
    const auto& names = biasMethodNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw UsageError("--method " + name + ": no such method");
    return BiasMethod(found - names.begin());
}

// [begin:errors]
DepthErrors depthErrors(const ShadowMap& map, const LightFrustum& frustum, const Aabb& bounds) {
    DepthErrors errors;
    const bool fixedPoint = map.format() == DepthFormat::fixed16 || map.format() == DepthFormat::fixed24;
    errors.quantum = fixedPoint ? glm::vec2(depthQuantum(map.format(), 1.0), 0.0) : glm::vec2(0.0, 0x1p-23);
    errors.snap = float(0.5 * subpixelStep());

    // Pass 1 transforms with 4 products and a rounded matrix; pass 2 does the same and then interpolates.
    const glm::dvec4 sizes = magnitudes(frustum.textureFromWorld(), bounds);
    const double gamma = (5.0 + 9.0) * roundOff;
    errors.rounding = glm::vec3(gamma * glm::dvec3(std::max(sizes.x, sizes.y), sizes.z, sizes.w));

    // The rasteriser works with z in [0,1]. Standard depth gets there by 0.5 z + 0.5, which rounds at 1 even
    // for small z.
    const bool standard = frustum.range == DepthRange::standard;
    errors.rasterError = glm::vec2(standard ? 2.0 * roundOff : 0.0, 4.0 * roundOff);

    const double middle = frustum.orthographic ? 0.0 : std::sqrt(frustum.near * frustum.far);
    const double halfDiagonal = 0.5 * glm::length(frustum.texelSize(middle, map.size()));
    constexpr double tan60 = 1.7320508075688772;
    errors.constant = float(halfDiagonal * tan60 * depthPerMetre(frustum, middle));
    return errors;
}
// [end:errors]

// [begin:caster-draw]
CasterDraw casterDraw(BiasMethod method, const ShadowMap& map, const LightFrustum& frustum,
                      const DepthErrors& errors, float scale) {
    CasterDraw draw;
    if (method == BiasMethod::frontFace) draw.frontFacesInstead = true;
    if (method == BiasMethod::midpoint) draw.cullClosed = false;
    if (method == BiasMethod::polygonOffset) {
        // m >= max(|dz/dx|, |dz/dy|) per texel, so S = (|z_u| + |z_v|) / 2 <= m: a factor of 1, and a little
        // for the snapping.
        draw.offsetFactor = scale * (1.0f + 2.0f * errors.snap);
        // A unit is the format's step, whatever that is: the number that is right for 24 bits is wrong
        // for 16.
        const double nearest = frustum.orthographic ? 1.0 : frustum.near;
        const double rounding =
            (errors.rounding.y + errors.rounding.z) / nearest + errors.rasterError.x + errors.rasterError.y;
        draw.offsetUnits = scale * float(1.0 + std::ceil(rounding / depthQuantum(map.format(), 0.5)));
    }
    return draw;
}
// [end:caster-draw]

}  // namespace penumbra
