// Percentage-closer filtering over a disk: fewer taps than texels, spread by a pattern that is the same for all pixels.
#include "04_pcf/receiver.glsl"

uniform float uRadius;       // texels
uniform int uSamples;
uniform sampler2D uPattern;  // texel i: point i of the unit disk

// Taps up to `radius` texels away in any direction: the most that z_s ds + z_t dt can be on a circle.
float reachOfDisk(Receiver receiver, float radius) {
    return radius * slopePerTexel(receiver, length(receiver.slope.value));
}

// [begin:disk]
vec2 patternOffset(int index) {
    return texelFetch(uPattern, ivec2(index, 0), 0).xy;
}

float diskVisibility(Receiver receiver) {
    float bias = kernelBias(receiver, reachOfDisk(receiver, uRadius));
    float lit = 0.0;
    for (int i = 0; i < uSamples; ++i)
        lit += litByTexel(receiver, texelBeside(receiver.str.xy, uRadius * patternOffset(i)), bias);
    return lit / float(uSamples);
}
// [end:disk]
