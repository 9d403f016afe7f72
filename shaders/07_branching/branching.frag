#include "02_shadow_test/shading.glsl"
#include "07_branching/classify.glsl"
#ifdef CONTACT_HARDENING
#include "07_branching/contact_hardening.glsl"
#endif

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;
in vec4 strq;

uniform vec4 uCasters;        // s and t beside which nothing stands above the floor: lower, upper corner
uniform float uNearestCaster; // oriented depth: larger is farther

uniform float uRed;           // radiance that is shown as full red

out vec4 outColor;

// What a pixel cost.
struct Work {
    bool receives;   // on the map, facing the light: not known without looking
    bool looked;     // at the map, or its minima and maxima
    bool searched;   // all taps were taken
};

// [begin:out-of-reach]
// Nothing that could cast a shadow lies between here and the light: known without the map. Where the bound on the bias does not
// hold, the floor could shadow itself, and chapter 06 would show it.
bool outOfReach(Receiver receiver) {
    vec2 st = receiver.str.xy;
    bool beside = any(lessThan(st, uCasters.xy)) || any(greaterThan(st, uCasters.zw));
    return uBias >= 1.0 && receiver.slope.atMost < uSteepest * receiver.perQ &&
           (beside || uFarther * receiver.str.z < uNearestCaster);
}
// [end:out-of-reach]

// [begin:loop-or-if]
#ifdef BRANCH_IF
// Chapter 06's loop written out. In an `if`, a CPU rasteriser runs all of it under a mask, needed or not.
float chunk(Taps taps, int first, int index) {
    if (index < first || index >= BRANCH_IF) return 0.0;
    return litOfEight(taps, index);
}
void addFourChunks(Taps taps, int first, int index, inout float sum) {
    sum += chunk(taps, first, index);
    sum += chunk(taps, first, index + 1);
    sum += chunk(taps, first, index + 2);
    sum += chunk(taps, first, index + 3);
}
float litOfRest(Taps taps, int first) {
    float sum = 0.0;
    addFourChunks(taps, first, 0, sum);
#if BRANCH_IF > 4
    addFourChunks(taps, first, 4, sum);
#endif
#if BRANCH_IF > 8
    addFourChunks(taps, first, 8, sum);
    addFourChunks(taps, first, 12, sum);
#endif
#if BRANCH_IF > 16
    addFourChunks(taps, first, 16, sum);
    addFourChunks(taps, first, 20, sum);
    addFourChunks(taps, first, 24, sum);
    addFourChunks(taps, first, 28, sum);
#endif
    return sum;
}
#endif
// [end:loop-or-if]

#if defined(CONTACT_HARDENING)
// [begin:contact-hardening]
// Lit or dark within the widest kernel is lit or dark within any: no search there.
float branchedVisibility(Receiver receiver, inout Work work) {
    Taps widest = tapsOf(receiver, vec2(uRadius));
    float known = work.looked ? classify(widest) : lit;
    vec2 kernel = hardenedKernel(receiver, widest, known == mixed);
    work.searched = known == mixed && kernel.x > 0.0;
    float sum = litOfChunks(tapsOf(receiver, kernel), 0, work.searched ? uSamples / 8 : 0);
    return work.searched ? sum / float(uSamples) : known == dark ? 0.0 : 1.0;
}
// [end:contact-hardening]
#elif defined(CLASSIFY_PROBE)
// [begin:probe]
// The lecture's scheme: eight taps on the outer ring, and the other 56 only if they disagree.
float branchedVisibility(Receiver receiver, inout Work work) {
    Taps taps = tapsOf(receiver, vec2(uRadius));
    int all = uSamples / 8;
    float probe = litOfChunks(taps, 0, work.looked ? 1 : 0);
    work.searched = work.looked && probe > 0.0 && probe < 8.0;
#ifdef BRANCH_IF
    if (work.searched) return (probe + litOfChunks(taps, 1, all)) / float(uSamples);
    return probe / 8.0;
#else
    float rest = litOfChunks(taps, 1, work.searched ? uSamples / 8 : 1);
    return work.looked ? (probe + rest) / (work.searched ? float(uSamples) : 8.0) : lit;
#endif
}
// [end:probe]
#elif defined(CLASSIFY_MIN_MAX)
// [begin:min-max]
// The cure: the minima and maxima know about every texel that a tap could read.
float branchedVisibility(Receiver receiver, inout Work work) {
    Taps taps = tapsOf(receiver, vec2(uRadius));
    float known = work.looked ? classify(taps) : lit;
    work.searched = known == mixed;
#ifdef BRANCH_IF
    if (work.searched) return litOfRest(taps, 0) / float(uSamples);
    return known;
#else
    float sum = litOfChunks(taps, 0, work.searched ? uSamples / 8 : 0);
    return work.searched ? sum / float(uSamples) : known;
#endif
}
// [end:min-max]
#else
float branchedVisibility(Receiver receiver, inout Work work) {
    Taps taps = tapsOf(receiver, vec2(uRadius));
    work.searched = true;
    return litOfChunks(taps, 0, uSamples / 8) / float(uSamples);
}
#endif

void main() {
    vec4 dx = dFdx(strq), dy = dFdy(strq);
    Receiver receiver;
    float S;
    bool onMap = receiverOnMap(strq, pWorld, dx, dy, receiver, S);
    bool facing = facesLight(pWorld, nWorld);
    Work work;
    work.receives = onMap && facing;
    work.looked = work.receives && !outOfReach(receiver);
    work.searched = false;
#ifdef CLASSIFY_NONE
    work.looked = onMap;
#endif
    float branched = branchedVisibility(receiver, work);
    if (onMap) S = branched;

    outColor = viewOf(pWorld, nWorld, vUv, S, facing);
    bool searched = work.searched && work.receives;
    if (uView == 3 && searched) outColor = vec4(uRed * vec3(0.9, 0.05, 0.02), 1.0);
    if (uView == 4) outColor = vec4(work.receives, work.looked && work.receives, searched, 1.0);
}
