// Lit, dark or mixed, for all taps of a kernel at once, from one look-up.
#include "06_jitter_texture/jitter.glsl"

uniform isampler2D uMinMax;
uniform vec2 uWindow;  // from s and t to the texel of uMinMax that stands for all around them: factor and offset
uniform float uReach;  // texels around a point that one texel of uMinMax stands for, at least

const float roundOff = 5.9604645e-8;  // 2^-24
const float dark = 0.0, lit = 1.0, mixed = 0.5;

// All depths of the window around a point are between plane.(s, t) + above and farthest.
struct Window {
    vec2 plane;
    float above, farthest;
};

Window windowAround(vec2 st) {
    vec4 texel = intBitsToFloat(textureLod(uMinMax, st * uWindow.x + uWindow.y, 0.0));
    return Window(texel.yz, texel.x, -texel.w);
}

// [begin:classify]
// Exact where it says lit or dark: then every tap agrees, whatever the pattern. `z`: what the tap in the middle is compared with. A
// tap at `o` is compared with z + slope.o, and reads a depth of at least above + plane.(st + o): so what counts is how the two
// slopes differ over the disk, and that the texel's centre lies footprintTexels off. On the plane itself both vanish, and only the
// bias is left. In the outer half of the map's outermost texels taps are moved inwards, off the disk: there nothing is known.
float classify(Taps taps) {
    Window window = windowAround(taps.st);
    float z = uFarther * (taps.z - taps.bias);
    vec2 slope = uFarther * taps.slope;
    float size = abs(window.plane.x) + abs(window.plane.y);
    float rounding = roundOff * (3.0 + 2.0 * (abs(slope.x) + abs(slope.y)));
    float texel = 1.0 / float(textureSize(uShadowMap, 0).x);
    float excess = length(taps.radius * (slope - window.plane)) + (footprintTexels * texel + 6.0 * roundOff) * size;
    bool surelyLit = z + excess + rounding <= window.above + dot(window.plane, taps.st);
    bool surelyDark = z - length(taps.radius * slope) - rounding > window.farthest;
    bool onDisk = taps.st == clamp(taps.st, taps.last.x, taps.last.y);
    return onDisk && surelyLit ? lit : onDisk && surelyDark ? dark : mixed;
}
// [end:classify]
