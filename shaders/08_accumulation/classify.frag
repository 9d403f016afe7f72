// Where all points of the light agree, their weights don't matter: lit or dark is known. Only mixed texels get a depth that the
// resolve pass can pass: rejected by the depth test before shading, the others cost it nothing.
#include "08_accumulation/mask_words.glsl"

uniform int uPoints;

layout(location = 0) out vec4 outSums;

// [begin:classify]
void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    bool hidden = false, seen = false;
    // The loop ends as soon as it is known.
    int layers = (uPoints + 31) / 32;
    for (int layer = 0; layer < layers && !(hidden && seen); ++layer) {
        int points = uPoints - 32 * layer;
        uint live = points < 32 ? (1u << uint(points)) - 1u : 0xffffffffu;
        uint word = maskWord(texel, layer) & live;
        hidden = hidden || word != 0u;
        seen = seen || word != live;
    }
    bool mixed = hidden && seen;
    outSums = mixed ? vec4(0.0) : vec4(seen ? 1.0 : 0.0, 1.0, 0.0, 0.0);
    gl_FragDepth = mixed ? 1.0 : 0.0;
}
// [end:classify]
