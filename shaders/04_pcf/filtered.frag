#include "02_shadow_test/shading.glsl"
#include "04_pcf/pcf.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;
in vec4 strq;

out vec4 outColor;

void main() {
    vec4 dx = dFdx(strq), dy = dFdy(strq);
    Receiver receiver;
    float S;
    if (receiverOnMap(strq, pWorld, dx, dy, receiver, S)) S = filteredVisibility(receiver);
    outColor = viewOf(pWorld, nWorld, vUv, S, facesLight(pWorld, nWorld));
}
