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
    float footprint = 0.5 * receiver.slope.atMost / mapSize;
    float z = receiver.str.z - uFarther * kernelBias(receiver, reachOfSquare(receiver, k) + footprint);
    float lit = 0.0;
    for (int j = 0; j < uKernelWidth; ++j)
        for (int i = 0; i < uKernelWidth; ++i)
            lit += textureLod(uShadowCompare, vec3(receiver.str.xy + (vec2(i, j) - k) / mapSize, z), 0.0);
    return lit / float(uKernelWidth * uKernelWidth);
}
// [end:bilinear]

// [begin:blended]
// The same, following the plane: one depth for four texels would be off by up to a texel's slope, and light would leak. So each
// texel is tested with the depth that the plane has at its own centre, and the blending is ours: of n + 1 texels in a row the
// first counts 1 - f, the last f, and those between, 1: two neighbouring taps share each.
float blendedPcf(Receiver receiver) {
    float n = float(uKernelWidth), k = 0.5 * (n - 1.0);
    ivec2 last = textureSize(uShadowMap, 0) - 1;
    vec2 first = receiver.str.xy * vec2(last + 1) - (k + 0.5), f = fract(first);
    float bias = kernelBias(receiver, reachOfSquare(receiver, k + 0.5)), lit = 0.0;
    for (int j = 0; j <= uKernelWidth; ++j) {
        for (int i = 0; i <= uKernelWidth; ++i) {
            vec2 ij = vec2(i, j), weight = clamp(min(ij + 1.0 - f, n - ij + f), 0.0, 1.0);
            ivec2 texel = clamp(ivec2(floor(first)) + ivec2(i, j), ivec2(0), last);
            lit += weight.x * weight.y * litByTexel(receiver, texel, bias);
        }
    }
    return lit / (n * n);
}
// [end:blended]

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
    if (uBilinear) return uFollowPlane > 0.0 ? blendedPcf(receiver) : bilinearPcf(receiver);
    return nearestPcf(receiver);
}
