// Shows the diffuse colour, with alpha 1, of whatever is drawn.
#include "common/material.glsl"

in vec3 vNormal;
in vec2 vUv;
layout(location = 0) out vec4 fragColor;

void main() {
    vec3 lit = materialDiffuse(vUv) + materialEmission();
    fragColor = vec4(lit, 0.5 + 0.5 * length(facingNormal(vNormal)));
}
