// Adds the weights of up to 32 x LAYERS light points to the sums: of those whose bit stayed clear, and of all. A fragment does four texels, so
// that each point is loaded once for four.
#include "08_accumulation/mask_words.glsl"
#include "08_accumulation/weight.glsl"

uniform int uFirstLayer;
uniform int uLayers;              // at most LAYERS
uniform vec4 uLightPoints[32 * LAYERS];

layout(location = 0) out vec4 outSeen;
layout(location = 1) out vec4 outAll;

// [begin:resolve]
void main() {
    vec2 first = pointOfTexel(vec2(4.0 * floor(gl_FragCoord.x) + 0.5, gl_FragCoord.y));
    vec4 x = first.x + uUEdge.x / uTexels.x * vec4(0.0, 1.0, 2.0, 3.0);
    vec4 seen = vec4(0.0), all = vec4(0.0);
    for (int layer = 0; layer < uLayers; ++layer) {
        uvec4 words = fourWords(ivec2(gl_FragCoord.xy), uFirstLayer + layer);
        for (int i = 0; i < 32; ++i) {
            vec4 f = weight(uLightPoints[32 * layer + i], x, first.y);
            bvec4 hidden = notEqual(words & (1u << uint(i)), uvec4(0u));
            seen += mix(f, vec4(0.0), hidden);
            all += f;
        }
    }
    outSeen = seen;
    outAll = all;
}
// [end:resolve]
