// For the tests of this chapter. A random receiver for each pixel: what classification says of it, and the share of 1024 taps that are lit.
#include "07_branching/classify.glsl"

uniform int uRound;
uniform vec2 uSlope0, uSlope1;  // two of the planes
layout(location = 0) out vec4 outResult;

uint hash(uint h) {
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

float random(int index) {
    uint pixel = hash(uint(gl_FragCoord.x) + hash(uint(gl_FragCoord.y) + hash(uint(uRound))));
    return float(hash(pixel + uint(index) * 0x9e3779b9u) >> 8) / 16777216.0;
}

void main() {
    vec2 size = vec2(textureSize(uShadowMap, 0)), st = vec2(random(0), random(1));
    // As deep as a surface of the neighbourhood, a little in front of it or behind it; on one of the planes, or at any slope.
    ivec2 texel = clamp(ivec2(st * size + 48.0 * (vec2(random(9), random(10)) - 0.5)), ivec2(0), ivec2(size) - 1);
    float z = texelFetch(uShadowMap, texel, 0).r + uFarther * (random(2) < 0.5 ? 0.0 : 0.3 * (random(3) - 0.3));
    z = clamp(z, 0.0, 1.0);  // as on any map
    int kind = int(4.0 * random(4));
    vec2 slope = kind == 0 ? uSlope0 : kind == 1 ? uSlope1 : kind == 2 ? vec2(0.0) : 4.0 * vec2(random(5), random(6)) - 2.0;
    float bias = uFarther * pow(10.0, -2.0 - 5.0 * random(7));
    vec2 radius = vec2(uRadius * (random(8) < 0.7 ? 1.0 : random(11))) / size;
    Taps taps = Taps(st, radius, z, uFarther * slope, vec2(0.5, size.x - 0.5) / size.x, bias, ivec2(0), vec2(1.0, 0.0));
    float known = classify(taps), lit = 0.0;
    for (int chunk = 0; chunk < uSamples / 8; ++chunk) lit += litOfEight(taps, chunk);
    outResult = vec4(known, lit / float(uSamples), 0.0, 1.0);
}
