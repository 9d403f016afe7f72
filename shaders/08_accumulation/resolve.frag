// Adds the weights of 32 light points to the sums: of those whose bit stayed clear, and of all.
#include "08_accumulation/mask_words.glsl"
#include "08_accumulation/weight.glsl"

uniform int uLayer;
uniform vec4 uLightPoints[32];

layout(location = 0) out vec4 outSums;

// [begin:resolve]
void main() {
    uint word = maskWord(ivec2(gl_FragCoord.xy), uLayer);
    vec2 texel = pointOfTexel(gl_FragCoord.xy);
    vec2 sums = vec2(0.0);
    for (int i = 0; i < 32; ++i) {
        float f = weight(uLightPoints[i], texel);
        bool hidden = (word & (1u << uint(i))) != 0u;
        sums += vec2(hidden ? 0.0 : f, f);
    }
    outSums = vec4(sums, 0.0, 0.0);
}
// [end:resolve]
