// Diffuse surfaces under a sky that they see a part of, or under a lamp.
#include "11_bent_normals/irradiance.glsl"
#include "common/light.glsl"
#include "common/material.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;
#if defined(STORED)
in vec4 vSeen;
#elif !defined(LAMP_ALONE)
uniform sampler2D uSeen;  // a texel for each pixel
#endif

uniform bool uLookUpBent;
uniform int uCombine;  // 0 principled, 1 adhoc, 2 none
uniform int uView;     // 0 color, 1 ambient, 2 bent-normal, 3 irradiance, 4 diffuse, 5 work

out vec4 outColor;

#ifdef LAMP_ALONE
// What is shown has nothing to do with the sky, and nobody has asked for it.
vec4 seenHere() { return vec4(0.0); }
vec3 bentNormal(vec3 bent, vec3 n) { return n; }
vec3 ambientIrradiance(vec4 seen, vec3 n) { return vec3(0.0); }
#else
// xyz: bent vector; w: ambient visibility. The hemisphere that a vertex shares with its neighbours may be a little less than empty.
vec4 seenHere() {
#ifdef STORED
    return vec4(vSeen.xyz, max(vSeen.w, 0.0));
#else
    return texelFetch(uSeen, ivec2(gl_FragCoord.xy), 0);
#endif
}

// [begin:bent-normal]
// Where nothing is seen there is no mean direction: the normal will do, since A is 0 there. A NaN would be 0 times NaN.
vec3 bentNormal(vec3 bent, vec3 n) {
    float squared = dot(bent, bent);
    return squared > 1e-12 ? bent * inversesqrt(squared) : n;
}
// [end:bent-normal]

// [begin:ambient-term]
vec3 ambientIrradiance(vec4 seen, vec3 n) {
#if defined(NORMALISED)
    return pairIrradiance(vec4(bentNormal(seen.xyz, n), seen.w));
#elif defined(LINEAR)
    return pairIrradiance(seen);
#else
    return seen.w * skyIrradiance(uLookUpBent ? bentNormal(seen.xyz, n) : n);
#endif
}
// [end:ambient-term]
#endif

// Blue: all is open; dark: nothing is; red: in between, where the look-ups differ.
vec3 workColour(float A) {
    return A >= 1.0 ? vec3(0.1, 0.25, 0.6) : A <= 0.0 ? vec3(0.05) : vec3(0.8, 0.1, 0.05);
}

void main() {
    vec3 n = facingNormal(nWorld);
    vec4 seen = seenHere();
    // [begin:combine]
    vec3 Kd = materialDiffuse(vUv);
    vec3 unshadowed = Kd / pi * facingIrradiance(pWorld) * max(dot(n, directionToLight(pWorld)), 0.0);
    vec3 E = ambientIrradiance(seen, n);
    vec3 radiance = uCombine == 0   ? Kd / pi * E          // what the sky gives
                    : uCombine == 1 ? unshadowed * seen.w  // the lecture's Kd (1 - occlusion) N.L
                                    : unshadowed;
    // [end:combine]
    vec3 value = radiance + materialEmission();
    if (uView == 1) value = vec3(seen.w);
    if (uView == 2) value = 0.5 + 0.5 * bentNormal(seen.xyz, n);
    if (uView == 3) value = E;
    if (uView == 4) value = unshadowed;
    if (uView == 5) value = workColour(seen.w);
    outColor = vec4(value, 1.0);
}
