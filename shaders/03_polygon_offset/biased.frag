#include "02_shadow_test/shading.glsl"
#include "02_shadow_test/shadow_lookup.glsl"
#include "03_polygon_offset/bias.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;
in vec4 strq;

uniform sampler2D uSecondLayer;  // midpoint
uniform float uBias;             // multiple of what the method asks for
uniform float uConstantBias;

out vec4 outColor;

// The triangle's own normal, towards the light: shading normals are smooth, and an offset along them misses facets.
vec3 geometricNormal(vec3 p, vec3 toLight) {
    vec3 n = normalize(cross(dFdx(p), dFdy(p)));
    return dot(n, toLight) < 0.0 ? -n : n;
}

// [begin:methods]
// METHOD is a define: each method is a program of its own, and pays for nothing that it doesn't use.
// dx, dy: differences of pShadow between neighbouring pixels.
float shadowTest(vec4 pShadow, vec4 dx, vec4 dy) {
    vec3 str;
    float decided;
    if (!projectOnMap(pShadow, str, decided)) return decided;
    float mapSize = float(textureSize(uShadowMap, 0).x), perQ = 1.0 / pShadow.w;
    DepthSlope slope = depthSlope(pShadow, str, dx, dy, perQ);
    vec3 rounding = roundingAt(pShadow, pWorld);
    float Q = quantumBias(str.z), C = roundingBias(slope, perQ, str.z, rounding);
    float bias = 0.0;  // none, front-face, and polygon-offset of fixed-point depths: what there is was done in pass 1

#if METHOD == CONSTANT
    bias = uConstantBias;
#elif METHOD == POLYGON_OFFSET
    if (uQuantum.y > 0.0) bias = Q + C;  // a unit of a float format is too small for this near the light
#elif METHOD == SLOPE
    bias = slopeBias(slope, perQ, mapSize, rounding) + Q + C;
#elif METHOD == NORMAL_OFFSET
    // The same S, spent along the normal: on any slope it is at most half a texel's diagonal, so nothing detaches.
    vec3 n = geometricNormal(pWorld, directionToLight(pWorld));
    vec4 step = uShadowTextureFromWorld * vec4(n, 0.0);
    vec3 gain = (step.xyz - str * step.w) * perQ;  // for a metre along n; what counts is the height above the plane
    float perMetre = abs(gain.z - dot(slope.value, gain.xy));
    vec3 offset = uBias * slopeBias(slope, perQ, mapSize, rounding) / perMetre * n;
    if (!projectOnMap(uShadowTextureFromWorld * vec4(pWorld + offset, 1.0), str, decided)) return decided;
    bias = Q + C;
#elif METHOD == RECEIVER_PLANE
    // Compare at the texel's centre, where the map's depth is from: S is gone, what is left is the slope's own error.
    vec2 toCentre = (vec2(texelAt(str.xy)) + 0.5) / mapSize - str.xy;
    // What the map holds ends at the far plane.
    str.z = clamp(str.z + dot(slope.value, toCentre), 0.0, 1.0);
    bias = planeBias(slope, perQ, mapSize, rounding) + Q + C;
#endif

    float zShadow = nearestDepth(texelAt(str.xy));
#if METHOD == MIDPOINT
    zShadow = 0.5 * (zShadow + texelFetch(uSecondLayer, texelAt(str.xy), 0).r);
#endif
    return uFarther * (str.z - zShadow) > uBias * bias ? 0.0 : 1.0;
}
// [end:methods]

void main() {
    // Differences to the neighbours come first: inside a branch they are undefined.
    vec4 dx = dFdx(strq), dy = dFdy(strq);
    float S = shadowTest(strq, dx, dy);
    outColor = viewOf(pWorld, nWorld, vUv, S, facesLight(pWorld, nWorld));
}
