// The stored visibility S(x, l): 32 light points in a word, a layer for each word; a set bit is a hidden point.
#ifdef BYTES
uniform sampler2DArray uMasks;  // where integers know no logic operation, the word is four bytes

uint maskWord(ivec2 texel, int layer) {
    uvec4 bytes = uvec4(255.0 * texelFetch(uMasks, ivec3(texel, layer), 0) + 0.5);
    return bytes.r | bytes.g << 8 | bytes.b << 16 | bytes.a << 24;
}
#else
uniform usampler2DArray uMasks;

uint maskWord(ivec2 texel, int layer) {
    return texelFetch(uMasks, ivec3(texel, layer), 0).r;
}
#endif
