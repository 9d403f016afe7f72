// What a filter has to know about the point it filters for. Chapters 04 to 07 look around it with different kernels.
#include "02_shadow_test/shadow_lookup.glsl"
#include "03_polygon_offset/bias.glsl"

uniform mat4 uShadowTextureFromWorld;
uniform float uBias;         // multiple of the derived bound
uniform float uFollowPlane;  // 1: a tap is compared with the receiver's plane at its texel's centre; 0: with the point's own depth

struct Receiver {
    vec3 str;         // where the point falls on the map, and its depth
    float q;
    DepthSlope slope;
};

// False when the map cannot tell, and `decided` is S by decree (chapter 02).
bool receiverOnMap(vec4 pShadow, Plane plane, out Receiver receiver, out float decided) {
    bool onMap = projectOnMap(pShadow, receiver.str, decided);
    receiver.q = pShadow.w;
    receiver.slope = depthSlope(uShadowTextureFromWorld, pShadow.w, receiver.str, plane);
    return onMap;
}

// [begin:kernel-bias]
// What a tap one texel further away along s, and along t, may be off by: all of the slope, or what is unsure of it if the plane
// is followed.
vec2 slopePerTexel(Receiver receiver) {
    vec2 slope = receiver.slope.atMost - uFollowPlane * abs(receiver.slope.value);
    return slope / float(textureSize(uShadowMap, 0).x);
}

// B of chapter 03, for taps whose depth may be off by `reach` because of where they are: (k + 1/2)(|z_s| + |z_t|) for a square of
// 2k + 1 texels is the 1/2 of one tap, and a reach of k(|z_s| + |z_t|).
float kernelBias(Receiver receiver, float reach) {
    int mapSize = textureSize(uShadowMap, 0).x;
    DepthSlope slope = receiver.slope;
    vec2 unsure = 2.0 * uSnap * slope.atMost + slope.atMost - abs(slope.value);
    float S = uFollowPlane > 0.0 ? 0.5 / float(mapSize) * (unsure.x + unsure.y) : slopeBias(slope, receiver.q, mapSize);
    return uBias * (S + reach + quantumBias(receiver.str.z) + roundingBias(slope, receiver.q, receiver.str.z));
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
