// Blinn-Phong from one light, S(x) = 1 everywhere: the picture that chapter 02 puts shadows into.
#include "common/blinn_phong.glsl"
#include "common/light.glsl"
#include "common/material.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;

uniform vec3 uEye;
uniform vec3 uAmbientRadiance;

out vec4 outColor;

void main() {
    vec3 diffuse = materialDiffuse(vUv);
    vec3 n = facingNormal(nWorld);
    vec3 toLight = directionToLight(pWorld);
    vec3 reflected = blinnPhong(n, toLight, normalize(uEye - pWorld), diffuse, uSpecular, uShininess);
    outColor = vec4(materialEmission() + uAmbientRadiance * diffuse + facingIrradiance(pWorld) * reflected, 1.0);
}
