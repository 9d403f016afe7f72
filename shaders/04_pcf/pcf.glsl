// Percentage-closer filtering (Reeves, Salesin & Cook 1987) over a square: the share of n x n tests that are lit.
#include "04_pcf/receiver.glsl"

uniform sampler2DShadow uShadowCompare;  // the same map, read through a comparison
uniform int uKernelWidth;                // n, texels
uniform bool uBilinear;
uniform bool uFilterDepths;

// [begin:pcf]
float nearestPcf(Receiver receiver) {
    float k = 0.5 * float(uKernelWidth - 1);
    float bias = kernelBias(receiver, reachOfSquare(receiver, k));
    float lit = 0.0;
    for (int j = 0; j < uKernelWidth; ++j)
        for (int i = 0; i < uKernelWidth; ++i)
            lit += litByTexel(receiver, texelBeside(receiver.str.xy, vec2(i, j) - k), bias);
    return lit / float(uKernelWidth * uKernelWidth);
}
// [end:pcf]

// [begin:bilinear]
// The sampler compares four texels and blends the results. Their centres lie up to one texel from the tap, not half a texel, and
// there is one depth for the four of them.
float bilinearPcf(Receiver receiver) {
    float k = 0.5 * float(uKernelWidth - 1), mapSize = float(textureSize(uShadowMap, 0).x);
    float footprint = mix(0.5, 1.0, uFollowPlane) * receiver.slope.atMost / mapSize;
    float bias = kernelBias(receiver, reachOfSquare(receiver, k) + footprint);
    float lit = 0.0;
    for (int j = 0; j < uKernelWidth; ++j) {
        for (int i = 0; i < uKernelWidth; ++i) {
            vec2 st = clamp(receiver.str.xy + (vec2(i, j) - k) / mapSize, 0.0, 1.0);
            lit += textureLod(uShadowCompare, vec3(st, receiverDepth(receiver, st) - uFarther * bias), 0.0);
        }
    }
    return lit / float(uKernelWidth * uKernelWidth);
}
// [end:bilinear]

// [begin:filter-depths]
// What a texture filter would do to the map: the mean of the depths, then one test. Half way between a wall and the floor behind
// it there is nothing, and the answer is still only yes or no.
float testOfFilteredDepths(Receiver receiver) {
    float k = 0.5 * float(uKernelWidth - 1), depth = 0.0;
    for (int j = 0; j < uKernelWidth; ++j)
        for (int i = 0; i < uKernelWidth; ++i) depth += nearestDepth(texelBeside(receiver.str.xy, vec2(i, j) - k));
    depth /= float(uKernelWidth * uKernelWidth);
    float bias = kernelBias(receiver, reachOfSquare(receiver, k));
    return uFarther * (receiver.str.z - depth) > bias ? 0.0 : 1.0;
}
// [end:filter-depths]

float filteredVisibility(Receiver receiver) {
    if (uFilterDepths) return testOfFilteredDepths(receiver);
    if (uBilinear) return bilinearPcf(receiver);
    return nearestPcf(receiver);
}
