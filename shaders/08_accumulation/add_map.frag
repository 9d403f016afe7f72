// Adds one light point's shadow map to the sums of every pixel: chapter 03's test, chapter 08's weights.
#include "04_pcf/receiver.glsl"
#include "common/light.glsl"
#include "common/material.glsl"

in vec3 pWorld;
in vec3 nWorld;

layout(location = 0) out vec4 outSums;

// [begin:add-map]
void main() {
    // Per pixel, not per vertex: a vertex behind this light point has no place on its map.
    vec4 pShadow = uShadowTextureFromWorld * vec4(pWorld, 1.0);
    vec4 dx = dFdx(pShadow), dy = dFdy(pShadow);
    Receiver receiver;
    float S;
    bool onMap = receiverOnMap(pShadow, pWorld, dx, dy, receiver, S);
    float tested = litByTexel(receiver, texelAt(receiver.str.xy), kernelBias(receiver, 0.0));
    // The light's emission is 1 here: facingIrradiance is the cosine at the light over r^2.
    float f = facingIrradiance(pWorld).r * max(dot(facingNormal(nWorld), directionToLight(pWorld)), 0.0);
    // An area light shines to 90 degrees, and its maps hold 75: of what lies outside, this point knows nothing and has no say.
    // Taken for lit, roofs and walls beside a window would be bright, whatever stands in between.
    if (!onMap && uLightType == lightArea) f = 0.0;
    outSums = vec4((onMap ? tested : S) * f, f, 0.0, 0.0);
}
// [end:add-map]
