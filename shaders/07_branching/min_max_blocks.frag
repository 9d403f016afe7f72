// The map in blocks of 8 x 8 texels: the nearest depth, measured from three planes, and the farthest. 1024^2 texels become 128^2.
#ifdef USE_GATHER
#extension GL_ARB_texture_gather : require
#endif
#include "07_branching/blocks.glsl"

uniform sampler2D uShadowMap;
uniform vec2 uSlope0, uSlope1, uSlope2;  // of the planes: change of depth for the whole map along s and along t

layout(location = 0) out ivec4 outBits;

float smallest(vec4 v) {
    vec2 m = min(v.xy, v.zw);
    return min(m.x, m.y);
}

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
void twoRows(ivec2 texel, vec2 size, out vec4 lower, out vec4 upper) {
    lower = row(texel, ivec2(size) - 1);
    upper = row(texel + ivec2(0, 1), ivec2(size) - 1);
}
#endif

// Larger is farther. Not a factor of -1 or 1: a twelfth of this shader's time.
vec4 oriented(vec4 depth) {
#ifdef REVERSED
    return -depth;
#else
    return depth;
#endif
}

// [begin:measure-from-planes]
// On a slope the nearest depth of a block says little: it is the slope's own. Measured from a plane of the same slope, all depths
// of the slope are equal, and whatever stands on it is nearer. What has been seen of four columns of a block, measured from the
// planes along t only: along s they are the same for every row.
struct Columns {
    vec4 above0, above1, above2;  // nearest
    vec4 farthest;
};

void addRow(inout Columns columns, vec4 depth, float t) {
    columns.above0 = min(columns.above0, depth - uSlope0.y * t);
    columns.above1 = min(columns.above1, depth - uSlope1.y * t);
    columns.above2 = min(columns.above2, depth - uSlope2.y * t);
    columns.farthest = max(columns.farthest, depth);
}

vec4 nearestOf(Columns columns, vec4 s) {
    return vec4(smallest(columns.above0 - uSlope0.x * s), smallest(columns.above1 - uSlope1.x * s),
                smallest(columns.above2 - uSlope2.x * s), smallest(-columns.farthest));
}
// [end:measure-from-planes]

void main() {
    ivec2 corner = block * ivec2(gl_FragCoord.xy), size = textureSize(uShadowMap, 0);
    float step = 1.0 / float(size.x);
    const vec4 none = vec4(3.4e38);
    vec4 nearest = none;
    for (int i = 0; i < block; i += 4) {
        Columns columns = Columns(none, none, none, -none);
        for (int j = 0; j < block; j += 2) {
            ivec2 texel = corner + ivec2(i, j);
            vec4 lower, upper;
            twoRows(texel, vec2(size), lower, upper);
            float t = (float(texel.y) + 0.5) * step;
            addRow(columns, oriented(lower), t);
            addRow(columns, oriented(upper), t + step);
        }
        nearest = min(nearest, nearestOf(columns, (float(corner.x + i) + vec4(0.5, 1.5, 2.5, 3.5)) * step));
    }
    outBits = orderedBits(floatBitsToInt(nearest));
}
