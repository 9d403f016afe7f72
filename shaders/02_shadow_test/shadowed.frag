#include "02_shadow_test/shading.glsl"
#include "02_shadow_test/shadow_lookup.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;
in vec4 strq;

out vec4 outColor;

// [begin:shadow-test]
// S(x): 1 when the light sees x. No bias: equal surfaces are compared as if depths were exact, and they are not.
float shadowTest(vec4 pShadow) {
    vec3 str;
    float decided;
    if (!projectOnMap(pShadow, str, decided)) return decided;
    float zLight = str.z;
    float zShadow = nearestDepth(texelAt(str.xy));
    return uFarther * zLight > uFarther * zShadow ? 0.0 : 1.0;
}
// [end:shadow-test]

void main() {
    float S = shadowTest(strq);
    outColor = viewOf(pWorld, nWorld, vUv, S, facesLight(pWorld, nWorld));
}
