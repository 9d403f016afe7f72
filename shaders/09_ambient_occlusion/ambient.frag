// Diffuse surfaces under a sky. How much of it a point sees comes from its normal (no define), from a texture with a texel for each
// pixel (PIXELS) or from the vertices (STORED).
#include "09_ambient_occlusion/hemisphere.glsl"
#include "common/material.glsl"

in vec3 nWorld;
in vec2 vUv;
in vec4 vStored;
in vec4 vLight;

#ifdef PIXELS
uniform sampler2D uStored;
uniform sampler2D uLight;
#endif
uniform vec3 uOnOpenGround;  // radiance of the sky as open ground sees it
uniform int uView;           // 0 color, 1 ambient, 2 bent-normal, 3 irradiance, 4 work

out vec4 outColor;

const float pi = 3.14159265358979;

// Blue: nothing could be in the way, no ray; grey: all rays agreed; red: they did not.
vec3 workColour(float work) {
    return work < 0.5 ? vec3(0.1, 0.25, 0.6) : work < 1.5 ? vec3(0.5) : vec3(0.8, 0.1, 0.05);
}

// [begin:shading]
void main() {
    vec3 n = facingNormal(nWorld);
#if defined(PIXELS)
    vec4 stored = texelFetch(uStored, ivec2(gl_FragCoord.xy), 0);
    vec4 light = texelFetch(uLight, ivec2(gl_FragCoord.xy), 0);
#elif defined(STORED)
    vec4 stored = vStored;
    vec4 light = vLight;
#else
    float seen = hemisphereTerm(n);
    vec4 stored = vec4(n, seen);
    vec4 light = vec4(seen * uOnOpenGround, 0.0);
#endif
    vec3 diffuse = materialDiffuse(vUv);
    vec3 value = diffuse * light.rgb + materialEmission();  // light is E / pi, and a diffuse surface sends on E diffuse / pi
    if (uView == 1) value = vec3(stored.a);
    if (uView == 2) value = 0.5 + 0.5 * (dot(stored.xyz, stored.xyz) > 0.0 ? normalize(stored.xyz) : n);
    if (uView == 3) value = pi * light.rgb;
    if (uView == 4) value = workColour(light.a);
    outColor = vec4(value, 1.0);
}
// [end:shading]
