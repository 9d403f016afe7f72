// The map in blocks of 8 x 8 texels: the nearest depth, measured from three planes, and the farthest. 1024^2 texels become 128^2.
#ifdef USE_GATHER
#extension GL_ARB_texture_gather : require
#endif
#include "07_branching/blocks.glsl"

uniform sampler2D uShadowMap;
uniform float uFarther;
uniform vec2 uSlope0, uSlope1, uSlope2;  // of the planes: change of depth for the whole map along s and along t

layout(location = 0) out ivec4 outBits;

float smallest(vec4 v) {
    vec2 m = min(v.xy, v.zw);
    return min(m.x, m.y);
}

// [begin:measure-from-planes]
// On a slope the nearest depth of a block says little: it is the slope's own. Measured from a plane of the same slope, all depths
// of the slope are equal, and whatever stands on it is nearer. Four texels in a row, each component one of them; along s the
// planes are the same for every row.
vec4 nearestOfRow(vec4 depth, vec4 plane0, vec4 plane1, vec4 plane2, float t) {
    return vec4(smallest(depth - plane0) - uSlope0.y * t, smallest(depth - plane1) - uSlope1.y * t,
                smallest(depth - plane2) - uSlope2.y * t, smallest(-depth));
}
// [end:measure-from-planes]

#ifdef USE_GATHER
// Two rows at a time, two texels wide: the sampler hands over four texels in one look-up, counter-clockwise from the upper left.
void twoRows(ivec2 texel, vec2 size, out vec4 lower, out vec4 upper) {
    vec4 left = textureGather(uShadowMap, (vec2(texel) + vec2(1.0)) / size);
    vec4 right = textureGather(uShadowMap, (vec2(texel) + vec2(3.0, 1.0)) / size);
    lower = vec4(left.wz, right.wz);
    upper = vec4(left.xy, right.xy);
}
#else
vec4 row(ivec2 texel, ivec2 last) {
    return vec4(texelFetch(uShadowMap, min(texel, last), 0).r,
                texelFetch(uShadowMap, min(texel + ivec2(1, 0), last), 0).r,
                texelFetch(uShadowMap, min(texel + ivec2(2, 0), last), 0).r,
                texelFetch(uShadowMap, min(texel + ivec2(3, 0), last), 0).r);
}
#endif

void main() {
    ivec2 corner = block * ivec2(gl_FragCoord.xy), size = textureSize(uShadowMap, 0);
    float step = 1.0 / float(size.x);
    vec4 nearest = vec4(3.4e38);
    for (int i = 0; i < block; i += 4) {
        vec4 s = (float(corner.x + i) + vec4(0.5, 1.5, 2.5, 3.5)) * step;
        vec4 plane0 = uSlope0.x * s, plane1 = uSlope1.x * s, plane2 = uSlope2.x * s;
        for (int j = 0; j < block; j += 2) {
            ivec2 texel = corner + ivec2(i, j);
            vec4 lower, upper;
#ifdef USE_GATHER
            twoRows(texel, vec2(size), lower, upper);
#else
            lower = row(texel, size - 1);
            upper = row(texel + ivec2(0, 1), size - 1);
#endif
            float t = (float(texel.y) + 0.5) * step;
            nearest = min(nearest, nearestOfRow(uFarther * lower, plane0, plane1, plane2, t));
            nearest = min(nearest, nearestOfRow(uFarther * upper, plane0, plane1, plane2, t + step));
        }
    }
    outBits = orderedBits(floatBitsToInt(nearest));
}
