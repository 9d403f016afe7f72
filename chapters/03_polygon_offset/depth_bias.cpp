#include "chapters/03_polygon_offset/depth_bias.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/error.h"

namespace penumbra {

namespace {

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

std::vector<std::string> biasDefines(BiasMethod method) {
    std::vector<std::string> defines{"METHOD " + std::to_string(int(method))};
    for (std::size_t i = 0; i < biasMethodNames().size(); ++i) {
        std::string name = biasMethodNames()[i];
        for (char& c : name) c = c == '-' ? '_' : char(std::toupper(c));
        defines.push_back(name + " " + std::to_string(i));
    }
    return defines;
}

DepthErrors bothPassesErrors(const ShadowMap& map, const LightFrustum& frustum, const Aabb& bounds) {
    return depthErrors(map.format(), frustum, bounds, 3 * transformOperations);
}

float constantBias(const LightFrustum& frustum, int mapSize) {
    const double middle = frustum.orthographic ? 0.0 : std::sqrt(frustum.near * frustum.far);
    const double halfDiagonal = 0.5 * glm::length(frustum.texelSize(middle, mapSize));
    constexpr double tan60 = 1.7320508075688772;
    return float(halfDiagonal * tan60 * depthPerMetre(frustum, middle));
}

float steepestSlope(const LightFrustum& frustum) {
    // A step d of the ray's direction moves the hit on a plane by (n.d)/(n.ray) of its distance, and
    // |n.d| / |n.ray| <= |d| (tan(theta) + 1) for a ray off the axis; 1 is for its own slant.
    constexpr double tan85 = 11.430052302761343;
    const double metres = (tan85 + 1.0) * 2.0 * (frustum.halfExtent.x + frustum.halfExtent.y);
    return float(metres * depthPerMetre(frustum, 1.0));
}

// [begin:caster-draw]
CasterDraw casterDraw(BiasMethod method, const LightFrustum& frustum, const DepthErrors& errors,
                      float scale) {
    CasterDraw draw;
    if (method == BiasMethod::frontFace) draw.frontFacesInstead = true;
    if (method == BiasMethod::midpoint) draw.cullClosed = false;
    if (method == BiasMethod::polygonOffset) {
        // m >= max(|dz/dx|, |dz/dy|) per texel, so S = (|z_u| + |z_v|) / 2 <= m: a factor of 1, and a little
        // for the snapping.
        draw.offsetFactor = scale * (1.0f + 2.0f * errors.snap);
        // A unit is the format's step, whatever that is: the number that is right for 24 bits is wrong
        // for 16. Of a float format it is the last bit of the triangle's own depth, near the light a
        // hundredth of what arithmetic rounds away: that is left to pass 2 then.
        const double nearest = frustum.orthographic ? 1.0 : frustum.near;
        const double rounding =
            (errors.rounding.y + errors.rounding.z) / nearest + errors.rasterError.x + errors.rasterError.y;
        draw.offsetUnits =
            scale * float(1.0 + (errors.quantum.y > 0.0f ? 0.0 : std::ceil(rounding / errors.quantum.x)));
    }
    return draw;
}
// [end:caster-draw]

void setDepthErrors(Program& program, const DepthErrors& errors, const LightFrustum& frustum) {
    program.set("uSteepest", steepestSlope(frustum));
    program.set("uQuantum", errors.quantum);
    program.set("uSnap", errors.snap);
    program.set("uRounding", errors.rounding);
    program.set("uRasterError", errors.rasterError);
}

}  // namespace penumbra
