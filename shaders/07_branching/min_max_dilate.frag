// Dilation, one direction at a time: the smallest of COUNT blocks in a row. Texel i of the result begins at block i - uBefore. The
// second direction, ALONG_T, also chooses the plane.
#include "07_branching/blocks.glsl"

uniform isampler2D uBlocks;
uniform int uBefore;
uniform int uMapSize;                    // texels
uniform vec2 uSlope0, uSlope1, uSlope2;  // as in min_max_blocks.frag

layout(location = 0) out ivec4 outBits;

#ifdef ALONG_T
const ivec2 direction = ivec2(0, 1);
#else
const ivec2 direction = ivec2(1, 0);
#endif

// [begin:best-plane]
// Of the three planes the one that in the middle of the window lies nearest below what is there: its own, where there is one
// surface. Nearest depth measured from that plane, the plane, minus the farthest depth.
vec4 withBestPlane(vec4 nearest) {
    vec2 middle = floor(gl_FragCoord.xy) - float(uBefore) + 0.5 * float(COUNT);
    vec2 st = middle * float(block) / float(uMapSize);
    vec3 below = nearest.xyz + vec3(dot(uSlope0, st), dot(uSlope1, st), dot(uSlope2, st));
    if (below.x >= max(below.y, below.z)) return vec4(nearest.x, uSlope0, nearest.w);
    if (below.y >= below.z) return vec4(nearest.y, uSlope1, nearest.w);
    return vec4(nearest.z, uSlope2, nearest.w);
}
// [end:best-plane]

// [begin:dilate]
void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) - uBefore * direction, last = textureSize(uBlocks, 0) - 1;
    ivec4 nearest = ivec4(0x7fffffff);
    // A constant bound: written out by the compiler, this pass takes half the time.
    for (int i = 0; i < COUNT; ++i)
        nearest = min(nearest, texelFetch(uBlocks, clamp(first + i * direction, ivec2(0), last), 0));
#ifdef ALONG_T
    nearest = floatBitsToInt(withBestPlane(intBitsToFloat(orderedBits(nearest))));
#endif
    outBits = nearest;
}
// [end:dilate]
