// Where all points of the light agree, their weights don't matter: lit or dark is known. Only mixed texels get a depth that the
// resolve pass can pass: rejected by the depth test before shading, the others cost it nothing.
#include "08_accumulation/mask_words.glsl"

uniform int uPoints;

layout(location = 0) out vec4 outSeen;
layout(location = 1) out vec4 outAll;

// [begin:classify]
void main() {
    uvec4 hidden = uvec4(0u), seen = uvec4(0u);
    bool mixed = false;
    // The loop ends as soon as it is known.
    int layers = (uPoints + 31) / 32;
    for (int layer = 0; layer < layers && !mixed; ++layer) {
        int points = uPoints - 32 * layer;
        uint live = points < 32 ? (1u << uint(points)) - 1u : 0xffffffffu;
        uvec4 words = fourWords(ivec2(gl_FragCoord.xy), layer);
        hidden |= words & live;
        seen |= ~words & live;
        mixed = any(notEqual(min(hidden, 1u) & min(seen, 1u), uvec4(0u)));
    }
    outSeen = mixed ? vec4(0.0) : vec4(notEqual(seen, uvec4(0u)));
    outAll = mixed ? vec4(0.0) : vec4(1.0);
    gl_FragDepth = mixed ? 1.0 : 0.0;
}
// [end:classify]
