// The smallest bias that can be proven to remove acne from planes: B = S + Q + C.
#include "03_polygon_offset/depth_slope.glsl"

uniform vec2 uQuantum;     // step of the stored depth: absolute, and relative to the depth (float formats)
uniform float uSnap;       // texels by which the rasteriser may move a vertex
uniform vec3 uRounding;    // errors of s (and t), r, q before the division, of pass 1 and pass 2 together
uniform vec2 uRasterError; // of an interpolated depth: constant part, and relative to the depth
uniform mat4 uShadowTextureFromWorld;

// [begin:measured-rounding]
// What interpolation rounds away has no bound of its own: of a triangle that clipping leaves 270 pixels long and a fifteenth of a
// pixel wide (a seam that runs into a corner of the picture), a rasteriser's plane equations lose thousands of units in the last
// place. But it shows: r, got another way, from the interpolated position, is off by about as much. One component tells of all; it
// may have come off lightly, hence the factor. Without this: specks along the seams of large triangles.
vec3 roundingAt(vec4 pShadow, vec3 pWorld) {
    mat4 m = uShadowTextureFromWorld;
    float off = abs(dot(vec4(m[0].z, m[1].z, m[2].z, m[3].z), vec4(pWorld, 1.0)) - pShadow.z);
    return uRounding * (1.0 + 8.0 * off / uRounding.y);
}
// [end:measured-rounding]

// [begin:bound]
// What a depth is off by because the point lies beside where float arithmetic has it.
float lateralBias(DepthSlope slope, float perQ, vec3 rounding) {
    return (rounding.x + rounding.z) * perQ * slope.atMost;
}

// S: the map's depth was taken at the texel's centre, up to half a texel away along s and along t.
float slopeBias(DepthSlope slope, float perQ, float mapSize, vec3 rounding) {
    return (0.5 + uSnap) / mapSize * slope.atMost + lateralBias(slope, perQ, rounding);
}

// S of a test at the texel's centre, with the depth that the receiver's plane has there: what is unsure of the slope.
float planeBias(DepthSlope slope, float perQ, float mapSize, vec3 rounding) {
    float unsure = (1.0 + 2.0 * uSnap) * slope.atMost - abs(slope.value.x) - abs(slope.value.y);
    return 0.5 / mapSize * unsure + lateralBias(slope, perQ, rounding);
}

// Q: what the depth format rounds away.
float quantumBias(float z) {
    return uQuantum.x + uQuantum.y * abs(z);
}

// C: what float arithmetic rounds away, from the vertices to here: the transforms, then the rasteriser's plane equation,
// whose terms can reach as far as depth changes across the whole map.
float roundingBias(DepthSlope slope, float perQ, float z, vec3 rounding) {
    float transforms = (rounding.y + abs(z) * rounding.z) * perQ;
    float interpolation = uRasterError.x + uRasterError.y * (abs(z) + slope.atMost);
    return transforms + interpolation;
}
// [end:bound]
