// Blinn-Phong with S(x), and the pictures of S itself. `S` is what the chapter is about; the rest is here.
#include "common/blinn_phong.glsl"
#include "common/light.glsl"
#include "common/material.glsl"

uniform vec3 uEye;
uniform vec3 uAmbientRadiance;
#ifdef VIEW
const int uView = VIEW;  // a program for each view: what it does not show is not computed
#else
uniform int uView;  // 0 color, 1 visibility, 2 shadow-kind
#endif

// [begin:blinn-phong]
// In shadow only the ambient term is left.
vec3 shadedRadiance(vec3 pWorld, vec3 nWorld, vec2 uv, float S) {
    vec3 diffuse = materialDiffuse(uv);
    vec3 reflected = blinnPhong(facingNormal(nWorld), directionToLight(pWorld), normalize(uEye - pWorld), diffuse,
                                uSpecular, uShininess);
    return materialEmission() + uAmbientRadiance * diffuse + S * facingIrradiance(pWorld) * reflected;
}
// [end:blinn-phong]

// [begin:shadow-kind]
// Attached: the surface faces away and needs no map to know it. Cast: it faces the light, and something is in between.
vec3 shadowKind(bool facing, float S) {
    const vec3 litColour = vec3(0.9), attachedColour = vec3(0.1, 0.2, 0.5), castColour = vec3(0.7, 0.15, 0.05);
    if (!facing) return attachedColour;
    return mix(castColour, litColour, S);
}
// [end:shadow-kind]

// A sign needs no unit vectors.
bool facesLight(vec3 pWorld, vec3 nWorld) {
    return dot(gl_FrontFacing ? nWorld : -nWorld, towardsLight(pWorld)) > 0.0;
}

// `facing`: facesLight of the point.
vec4 viewOf(vec3 pWorld, vec3 nWorld, vec2 uv, float S, bool facing) {
    if (!facing) S = 0.0;
    vec3 radiance = shadedRadiance(pWorld, nWorld, uv, S);
    if (uView == 1) return vec4(vec3(S), 1.0);
    if (uView == 2) return vec4(shadowKind(facing, S), 1.0);
    return vec4(radiance, 1.0);
}
