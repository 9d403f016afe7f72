// Shows diffuse colour and emission of whatever is drawn; with SHOW_GLOSS its highlight: specular colour and exponent.
#include "common/material.glsl"

in vec3 vNormal;
in vec2 vUv;
layout(location = 0) out vec4 fragColor;

void main() {
    vec3 lit = materialDiffuse(vUv) + materialEmission();
    fragColor = vec4(lit, 0.5 + 0.5 * length(facingNormal(vNormal)));
#ifdef SHOW_GLOSS
    fragColor = vec4(uSpecular, uShininess);
#endif
}
