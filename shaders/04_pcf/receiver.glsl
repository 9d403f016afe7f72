// What a filter has to know about the point it filters for. Chapters 04 to 07 look around it with different kernels.
#include "02_shadow_test/shadow_lookup.glsl"
#include "03_polygon_offset/bias.glsl"

uniform float uBias;         // multiple of the derived bound
uniform float uFollowPlane;  // 1: a tap is compared with the receiver's plane at its texel's centre; 0: with the point's own depth

struct Receiver {
    vec3 str;    // where the point falls on the map, and its depth
    float perQ;  // 1 / q
    DepthSlope slope;
    vec3 rounding;  // of s (and t), r, q before the division
};

// False when the map cannot tell, and `decided` is S by decree (chapter 02). dx, dy: differences of pShadow between neighbouring
// pixels, taken before any branch.
bool receiverOnMap(vec4 pShadow, vec3 pWorld, vec4 dx, vec4 dy, out Receiver receiver, out float decided) {
    bool onMap = projectOnMap(pShadow, receiver.str, decided);
    receiver.perQ = 1.0 / pShadow.w;
    receiver.slope = depthSlope(pShadow, receiver.str, dx, dy, receiver.perQ);
    receiver.rounding = roundingAt(pShadow, pWorld);
    return onMap;
}

// [begin:kernel-bias]
// What the depth a texel further away, in the worst direction, may be off by: what is unsure of the slope, and the slope itself
// (`worst`, of dz/ds and dz/dt) unless the plane is followed.
float slopePerTexel(Receiver receiver, float worst) {
    vec2 slope = abs(receiver.slope.value);
    float unsure = max(receiver.slope.atMost - slope.x - slope.y, 0.0);
    return (unsure + (1.0 - uFollowPlane) * worst) / float(textureSize(uShadowMap, 0).x);
}

// Taps up to `texels` away along s and along t.
float reachOfSquare(Receiver receiver, float texels) {
    return texels * slopePerTexel(receiver, abs(receiver.slope.value.x) + abs(receiver.slope.value.y));
}

// B of chapter 03, for taps whose depth may be off by `reach` because of where they are: (k + 1/2)(|z_s| + |z_t|) for a square of
// 2k + 1 texels is the 1/2 of one tap, and a reach of k(|z_s| + |z_t|).
float kernelBias(Receiver receiver, float reach) {
    float mapSize = float(textureSize(uShadowMap, 0).x);
    DepthSlope slope = receiver.slope;
    float perQ = receiver.perQ, z = receiver.str.z;
    float S = uFollowPlane > 0.0 ? planeBias(slope, perQ, mapSize, receiver.rounding)
                                 : slopeBias(slope, perQ, mapSize, receiver.rounding);
    return uBias * (S + reach + quantumBias(z) + roundingBias(slope, perQ, z, receiver.rounding));
}
// [end:kernel-bias]

// [begin:tap]
// `offset` texels beside the point. Beyond the border of the map its last texels go on for ever.
ivec2 texelBeside(vec2 st, vec2 offset) {
    ivec2 size = textureSize(uShadowMap, 0);
    return clamp(ivec2(floor(st * vec2(size) + offset)), ivec2(0), size - 1);
}

// The depth to compare with: the point's own, or that of its plane at `st`, without an `if`. What the map holds ends at its planes.
float receiverDepth(Receiver receiver, vec2 st) {
    float z = receiver.str.z + dot(uFollowPlane * receiver.slope.value, st - receiver.str.xy);
    return clamp(z, 0.0, 1.0);
}

// One test, chapter 03's: 1 lit, 0 in shadow.
float litByTexel(Receiver receiver, ivec2 texel, float bias) {
    vec2 centre = (vec2(texel) + 0.5) / vec2(textureSize(uShadowMap, 0));
    return uFarther * (receiverDepth(receiver, centre) - nearestDepth(texel)) > bias ? 0.0 : 1.0;
}
// [end:tap]
