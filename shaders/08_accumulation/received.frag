// A receiver with its own texture of light.
#include "08_accumulation/diffuse.glsl"

in vec3 pWorld;
in vec2 vUv;

uniform sampler2D uReceived;
uniform vec4 uTexelX;  // texel coordinates of a point: dot(uTexelX, (p, 1)), with texel i's centre at i + 1/2
uniform vec4 uTexelY;

out vec4 outColor;

// [begin:look-up]
// Bilinear by hand: float textures cannot be filtered everywhere.
vec3 received(vec2 texel) {
    vec2 p = texel - 0.5, cell = floor(p), t = p - cell;
    ivec2 a = ivec2(cell), last = textureSize(uReceived, 0) - 1;
    ivec2 lower = clamp(a, ivec2(0), last), upper = clamp(a + 1, ivec2(0), last);
    vec3 below = mix(texelFetch(uReceived, lower, 0).rgb, texelFetch(uReceived, ivec2(upper.x, lower.y), 0).rgb, t.x);
    vec3 above = mix(texelFetch(uReceived, ivec2(lower.x, upper.y), 0).rgb, texelFetch(uReceived, upper, 0).rgb, t.x);
    return mix(below, above, t.y);
}
// [end:look-up]

void main() {
    vec4 p = vec4(pWorld, 1.0);
    vec3 light = received(vec2(dot(uTexelX, p), dot(uTexelY, p)));
    outColor = vec4(uView == 0 ? diffuseRadiance(light, vUv) : light, 1.0);
}
