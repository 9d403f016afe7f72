// Dilation, one direction at a time: the smallest of uCount blocks in a row. Texel i of the result begins at block i - uBefore.
uniform isampler2D uBlocks;
uniform ivec2 uDirection;
uniform int uCount;
uniform int uBefore;

layout(location = 0) out ivec4 outBits;

// [begin:dilate]
void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) - uBefore * uDirection, last = textureSize(uBlocks, 0) - 1;
    ivec4 nearest = ivec4(0x7fffffff);
    int i = 0;  // at the end of the body, as in chapter 06
    do nearest = min(nearest, texelFetch(uBlocks, clamp(first + i * uDirection, ivec2(0), last), 0));
    while (++i < uCount);
    outBits = nearest;
}
// [end:dilate]
