// Percentage-closer soft shadows (Fernando 2005, SIGGRAPH sketches): shadows harden towards contacts, because the kernel is as
// wide as the light looks from the receiver past its blockers. The blockers are taken for one plane parallel to the light.
#include "07_branching/blocks.glsl"
#include "07_branching/classify.glsl"

uniform float uLightRadius;  // metres, of the disk of the light's area
uniform vec2 uHalfExtent;    // half of the map's size on a plane a metre away
uniform vec2 uNearFar;       // metres

const int searchTaps = 32;

float metres(float z) {
    float share = uFarther > 0.0 ? z : 1.0 - z;
    return uNearFar.x * uNearFar.y / (uNearFar.y - share * (uNearFar.y - uNearFar.x));
}

// [begin:kernel-of-blocker]
// Texels that the light covers on the map, seen from a receiver through a pinhole in the blocker: similar triangles.
vec2 kernelOf(float receiver, float blocker) {
    float radius = uLightRadius * max(receiver - blocker, 0.0) / blocker;
    vec2 texels = radius / (2.0 * uHalfExtent * receiver) * float(textureSize(uShadowMap, 0).x);
    return min(texels, vec2(uRadius));
}
// [end:kernel-of-blocker]

// [begin:blocker-bound]
// No blocker is nearer to the light than this: from the minimum, which is there already. So none needs to be searched for
// beyond the kernel of such a blocker.
float nearestBlocker(vec2 st) {
    Window window = windowAround(st);
    float around = (uReach + float(block)) / float(textureSize(uShadowMap, 0).x);
    float z = window.above + dot(window.plane, st) - around * (abs(window.plane.x) + abs(window.plane.y));
    return metres(clamp(uFarther * z, 0.0, 1.0));
}
// [end:blocker-bound]

// [begin:blocker-search]
// The mean distance of what blocks, then the kernel of that. (0, 0): nothing blocks.
vec2 hardenedKernel(Receiver receiver, Taps widest, bool wanted) {
    float here = metres(receiver.str.z);
    vec2 search = kernelOf(here, nearestBlocker(receiver.str.xy)) / float(textureSize(uShadowMap, 0).x);
    vec2 turn = randomTurn();
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < (wanted ? searchTaps : 0); ++i) {
        float turns = 2.399963230 * float(i), r = sqrt((float(i) + 0.5) / float(searchTaps));
        vec2 p = r * vec2(cos(turns) * turn.x - sin(turns) * turn.y, cos(turns) * turn.y + sin(turns) * turn.x);
        vec2 st = clamp(widest.st + search * p, widest.last.x, widest.last.y);
        float z = clamp(widest.z + dot(widest.slope, st - widest.st), 0.0, 1.0) - widest.bias;
        float depth = nearestDepth(texelAt(st));
        float blocks = uFarther * (z - depth) > 0.0 ? 1.0 : 0.0;
        sum += blocks * metres(depth);
        count += blocks;
    }
    return count > 0.0 ? kernelOf(here, sum / count) : vec2(0.0);
}
// [end:blocker-search]
