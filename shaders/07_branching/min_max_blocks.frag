// The map in blocks of 4 x 4 texels: the nearest depth, measured from three planes, and the farthest. 1024^2 texels become 256^2.
#ifdef USE_GATHER
#extension GL_ARB_texture_gather : require
#endif
#include "07_branching/order.glsl"

uniform sampler2D uShadowMap;
uniform float uFarther;
uniform vec2 uSlope0, uSlope1, uSlope2;  // of the planes: change of depth for the whole map along s and along t

layout(location = 0) out ivec4 outBits;

// [begin:measure-from-planes]
// On a slope the nearest depth of a block says little: it is the slope's own. Measured from a plane of the same slope, all depths
// of the slope are equal, and whatever stands on it is nearer. Four texels in a row, each component one of them.
vec4 nearestOfRow(vec4 depth, vec2 first, float texel) {
    vec4 s = first.x + texel * vec4(0.0, 1.0, 2.0, 3.0);
    vec4 e0 = depth - (uSlope0.x * s + uSlope0.y * first.y);
    vec4 e1 = depth - (uSlope1.x * s + uSlope1.y * first.y);
    vec4 e2 = depth - (uSlope2.x * s + uSlope2.y * first.y);
    vec2 m0 = min(e0.xy, e0.zw), m1 = min(e1.xy, e1.zw), m2 = min(e2.xy, e2.zw), far = max(depth.xy, depth.zw);
    return vec4(min(m0.x, m0.y), min(m1.x, m1.y), min(m2.x, m2.y), -max(far.x, far.y));
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
    ivec2 texel = 4 * ivec2(gl_FragCoord.xy), size = textureSize(uShadowMap, 0);
    float step = 1.0 / float(size.x);
    vec4 rows[4];
#ifdef USE_GATHER
    twoRows(texel, vec2(size), rows[0], rows[1]);
    twoRows(texel + ivec2(0, 2), vec2(size), rows[2], rows[3]);
#else
    for (int j = 0; j < 4; ++j) rows[j] = row(texel + ivec2(0, j), size - 1);
#endif
    vec4 nearest = vec4(3.4e38);
    for (int j = 0; j < 4; ++j)
        nearest = min(nearest, nearestOfRow(uFarther * rows[j], (vec2(texel) + vec2(0.5, float(j) + 0.5)) * step, step));
    outBits = orderedBits(floatBitsToInt(nearest));
}
