// A texture of light, or one hard shadow image of it, as it is: for looking at.
#include "08_accumulation/mask_words.glsl"

uniform sampler2D uReceived;
uniform ivec2 uOrigin;      // of the viewport, pixels
uniform ivec2 uShownSize;   // pixels
uniform int uPoint;         // -1: the texture; else the hard shadow image of this light point

layout(location = 0) out vec4 outColor;

void main() {
    vec2 uv = (gl_FragCoord.xy - vec2(uOrigin)) / vec2(uShownSize);
    ivec2 size = textureSize(uReceived, 0);
    ivec2 texel = min(ivec2(uv * vec2(size)), size - 1);
    outColor = texelFetch(uReceived, texel, 0);
    if (uPoint >= 0) {
        bool hidden = (maskWord(texel, uPoint / 32) & (1u << uint(uPoint % 32))) != 0u;
        outColor = vec4(vec3(hidden ? 0.0 : 1.0), 1.0);
    }
}
