// The stored visibility S(x, l): 32 light points in a word, a layer for each word; a set bit is a hidden point.
#ifdef BYTES
uniform sampler2DArray uMasks;  // where integers know no logic operation, the word is four bytes
#else
uniform usampler2DArray uMasks;
#endif

uint maskWord(ivec2 texel, int layer) {
#ifdef BYTES
    uvec4 bytes = uvec4(255.0 * texelFetch(uMasks, ivec3(texel, layer), 0) + 0.5);
    return bytes.r | bytes.g << 8 | bytes.b << 16 | bytes.a << 24;
#else
    return texelFetch(uMasks, ivec3(texel, layer), 0).r;
#endif
}

// The words of the four texels of a row that one fragment of the sums stands for.
uvec4 fourWords(ivec2 fragment, int layer) {
    int x = 4 * fragment.x, y = fragment.y, last = textureSize(uMasks, 0).x - 1;
    return uvec4(maskWord(ivec2(x, y), layer), maskWord(ivec2(min(x + 1, last), y), layer),
                 maskWord(ivec2(min(x + 2, last), y), layer), maskWord(ivec2(min(x + 3, last), y), layer));
}
