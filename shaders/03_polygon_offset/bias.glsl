// The smallest bias that can be proven to remove acne from planes: B = S + Q + C.
#include "03_polygon_offset/depth_slope.glsl"

uniform vec2 uQuantum;     // step of the stored depth: absolute, and relative to the depth (float formats)
uniform float uSnap;       // texels by which the rasteriser may move a vertex
uniform vec3 uRounding;    // errors of s (and t), r, q before the division, of pass 1 and pass 2 together
uniform vec2 uRasterError; // of an interpolated depth: constant part, and relative to the depth

// [begin:bound]
// S: the map's depth was taken at the texel's centre, up to half a texel away along s and along t.
float slopeBias(DepthSlope slope, float perQ, float mapSize) {
    float texels = 0.5 + uSnap + mapSize * (uRounding.x + uRounding.z) * perQ;
    return texels / mapSize * slope.atMost;
}

// Q: what the depth format rounds away.
float quantumBias(float z) {
    return uQuantum.x + uQuantum.y * abs(z);
}

// C: what float arithmetic rounds away, from the vertices to here: the transforms, then the rasteriser's plane equation,
// whose terms can reach as far as depth changes across the whole map.
float roundingBias(DepthSlope slope, float perQ, float z) {
    float transforms = (uRounding.y + abs(z) * uRounding.z) * perQ;
    float interpolation = uRasterError.x + uRasterError.y * (abs(z) + slope.atMost);
    return transforms + interpolation;
}
// [end:bound]
