#include "02_shadow_test/shading.glsl"
#include "06_jitter_texture/jitter.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;
in vec4 strq;

out vec4 outColor;

// [begin:jittered]
float jitteredVisibility(Receiver receiver) {
    Taps taps = tapsOf(receiver, vec2(uRadius));
    return litOfChunks(taps, 0, uSamples / 8) / float(uSamples);
}
// [end:jittered]

void main() {
    vec4 dx = dFdx(strq), dy = dFdy(strq);
    Receiver receiver;
    float S;
    if (receiverOnMap(strq, pWorld, dx, dy, receiver, S)) S = jitteredVisibility(receiver);
    outColor = viewOf(pWorld, nWorld, vUv, S, facesLight(pWorld, nWorld));
}
