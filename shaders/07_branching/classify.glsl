// Lit, dark or mixed, for all taps of a kernel at once, from one look-up.
#include "06_jitter_texture/jitter.glsl"
#include "07_branching/blocks.glsl"

uniform isampler2D uMinMax;
uniform float uReach;   // texels around a point that one texel of uMinMax stands for, at least
uniform int uBefore;    // blocks that it begins before the map
uniform vec2 uSlope0, uSlope1, uSlope2;

const float roundOff = 5.9604645e-8;  // 2^-24
const float dark = 0.0, lit = 1.0, mixed = 0.5;

// The nearest depth of the window around `st`, measured from the three planes, and minus the farthest depth.
vec4 nearestAround(vec2 st) {
    vec2 corner = floor(st * vec2(textureSize(uShadowMap, 0)) - uReach);
    return intBitsToFloat(orderedBits(texelFetch(uMinMax, ivec2(floor(corner / float(block))) + uBefore, 0)));
}

// [begin:surely-lit]
// `z`: what the tap in the middle is compared with. A tap at `o` is compared with z + slope.o, and reads a depth of at least
// nearest + plane.(st + o): so what counts is how the two slopes differ over the disk, and that the texel's centre lies
// footprintTexels off. On the plane itself both vanish, and only the bias is left.
bool surelyLit(Taps taps, float z, vec2 slope, float nearest, vec2 plane) {
    float texel = 1.0 / float(textureSize(uShadowMap, 0).x);
    float size = abs(plane.x) + abs(plane.y);
    float rounding = roundOff * (3.0 + 6.0 * size + 2.0 * (abs(slope.x) + abs(slope.y)));
    float excess = length(taps.radius * (slope - plane)) + footprintTexels * texel * size + rounding;
    return z + excess <= nearest + dot(plane, taps.st);
}
// [end:surely-lit]

// [begin:classify]
// Exact where it says lit or dark: then every tap agrees, whatever the pattern.
float classify(Taps taps) {
    vec4 nearest = nearestAround(taps.st);
    float z = uFarther * (taps.z - taps.bias);
    vec2 slope = uFarther * taps.slope;
    // Of the three planes the one most like the receiver's.
    vec2 off0 = slope - uSlope0, off1 = slope - uSlope1, off2 = slope - uSlope2;
    float square0 = dot(off0, off0), square1 = dot(off1, off1), square2 = dot(off2, off2);
    bool first = square0 <= min(square1, square2), second = square1 <= square2;
    float above = first ? nearest.x : second ? nearest.y : nearest.z;
    if (surelyLit(taps, z, slope, above, first ? uSlope0 : second ? uSlope1 : uSlope2)) return lit;
    float rounding = roundOff * (3.0 + 2.0 * (abs(slope.x) + abs(slope.y)));
    return z - length(taps.radius * slope) - rounding > -nearest.w ? dark : mixed;
}
// [end:classify]
