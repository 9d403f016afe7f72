#include "02_shadow_test/shading.glsl"
#include "02_shadow_test/shadow_lookup.glsl"
#include "03_polygon_offset/bias.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;
in vec4 strq;

uniform mat4 uShadowTextureFromWorld;
uniform sampler2D uSecondLayer;  // midpoint
uniform int uMethod;
uniform float uBias;             // multiple of what the method asks for
uniform float uConstantBias;

const int methodNone = 0, methodConstant = 1, methodPolygonOffset = 2, methodSlope = 3, methodReceiverPlane = 4,
          methodNormalOffset = 5, methodFrontFace = 6, methodMidpoint = 7;

out vec4 outColor;

// [begin:methods]
float shadowTest(vec4 pShadow, Plane plane) {
    vec3 str;
    float decided;
    if (!projectOnMap(pShadow, str, decided)) return decided;
    int mapSize = textureSize(uShadowMap, 0).x;
    DepthSlope slope = depthSlope(uShadowTextureFromWorld, pShadow.w, str, plane);
    float Q = quantumBias(str.z), C = roundingBias(slope, pShadow.w, str.z);
    float bias = 0.0;  // none, polygon-offset, front-face: what there is was done in pass 1

    if (uMethod == methodConstant) {
        bias = uConstantBias;
    } else if (uMethod == methodSlope) {
        bias = slopeBias(slope, pShadow.w, mapSize) + Q + C;
    } else if (uMethod == methodNormalOffset) {
        // The same S, spent along the normal: on any slope it is at most half a texel's diagonal, so nothing detaches.
        vec3 offset = uBias * slopeBias(slope, pShadow.w, mapSize) / slope.perMetre * plane.normal;
        if (!projectOnMap(uShadowTextureFromWorld * vec4(pWorld + offset, 1.0), str, decided)) return decided;
        bias = Q + C;
    } else if (uMethod == methodReceiverPlane) {
        // Compare at the texel's centre, where the map's depth is from: S is gone, what is left is the slope's own error.
        vec2 toCentre = (vec2(texelAt(str.xy)) + 0.5) / float(mapSize) - str.xy;
        // What the map holds ends at the far plane.
        str.z = clamp(str.z + dot(slope.value, toCentre), 0.0, 1.0);
        vec2 unsure = 2.0 * uSnap * slope.atMost + slope.atMost - abs(slope.value);
        bias = Q + C + 0.5 / float(mapSize) * (unsure.x + unsure.y);
    }

    float zShadow = nearestDepth(texelAt(str.xy));
    if (uMethod == methodMidpoint) zShadow = 0.5 * (zShadow + texelFetch(uSecondLayer, texelAt(str.xy), 0).r);
    return uFarther * (str.z - zShadow) > uBias * bias ? 0.0 : 1.0;
}
// [end:methods]

void main() {
    Plane plane = receiverPlane(pWorld, nWorld, directionToLight(pWorld));
#ifdef NO_SHADOW
    float S = 1.0;  // the benchmark's yardstick: the same pass without the look-up
#else
    float S = shadowTest(strq, plane);
#endif
    outColor = viewOf(pWorld, nWorld, vUv, S);
}
