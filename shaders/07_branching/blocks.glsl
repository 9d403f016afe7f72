// What the passes that make the minimum-maximum map agree on.
const int block = 8;  // texels along a side; MinMaxMap::block

// Floats as integers in the same order, so that one integer target, which OpenGL ES 3.0 can render to everywhere, holds depths
// and differences of depths exactly. Its own inverse.
ivec4 orderedBits(ivec4 bits) {
    return bits ^ ((bits >> 31) & 0x7fffffff);
}
