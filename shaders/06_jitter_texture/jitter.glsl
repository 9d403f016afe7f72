// Percentage-closer filtering with a pattern of its own for every pixel. Eight tests at a time: that is what one look-up of the
// packed pattern brings, and it is the outer ring when the chunk is the first.
#include "05_jittered_disk/disk.glsl"

uniform sampler2DShadow uShadowCompare;  // the same map, read through a comparison
uniform int uSeed;

#if defined(JITTER_SNORM8) || defined(JITTER_LECTURE)
uniform sampler3D uJitter;
#else
uniform usampler3D uJitter;
#endif

// How far the centre of a texel that a tap reads may lie from it, along s and along t.
#ifdef JITTER_LECTURE
const float footprintTexels = 1.0;
#else
const float footprintTexels = 0.5;
#endif

// What the tests of one point share.
struct Taps {
    vec2 st;       // the point on the map
    vec2 radius;   // of the disk, in s and t
    float z;       // the depth to compare with at the point, and how it changes along s and t
    vec2 slope;
    vec2 last;     // where s and t of taps end: the centres of the map's first and last texels
    float bias;    // away from the light is positive
    ivec2 column;  // the pixel's pattern; rotation: unused
    vec2 turn;     // rotation: cosine and sine of the pixel's angle
};

// [begin:rotation]
// A hash of the pixel as an angle: it needs no texture, and a spiral for each tap instead of a look-up for eight.
vec2 randomTurn() {
    uint h = uint(gl_FragCoord.x) * 0x9e3779b9u + uint(gl_FragCoord.y) * 0x85ebca6bu + uint(uSeed) * 0xc2b2ae35u;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    float angle = 6.283185307 * float((h ^ (h >> 16)) >> 8) / 16777216.0;
    return vec2(cos(angle), sin(angle));
}
// [end:rotation]

// `radius`: texels along s and along t.
Taps tapsOf(Receiver receiver, vec2 radius) {
    float mapSize = float(textureSize(uShadowMap, 0).x);
    // The sampler compares at the tap, not at the texel's centre up to half a texel away; bilinear, a texel away.
    float footprint = (footprintTexels - 0.5 + 0.5 * uFollowPlane) * receiver.slope.atMost / mapSize;
    float reach = reachOfDisk(receiver, max(radius.x, radius.y));
    float bias = uFarther * kernelBias(receiver, reach + footprint);
    vec2 turn = vec2(1.0, 0.0);
#ifdef JITTER_ROTATION
    turn = randomTurn();
    ivec2 column = ivec2(0);
#else
    // mod, not %: CPUs divide floats eight at a time, and integers one by one.
    ivec2 column = ivec2(mod(gl_FragCoord.xy, vec2(textureSize(uJitter, 0).xy)));
#endif
    return Taps(receiver.str.xy, radius / mapSize, receiver.str.z, uFollowPlane * receiver.slope.value,
                vec2(0.5, mapSize - 0.5) / mapSize, bias, column, turn);
}

// [begin:tap]
// `p` of the unit disk. Compared by the sampler: as fast as a look-up, where fetching a depth and comparing it is half as fast.
float litTap(Taps taps, vec2 p) {
    vec2 st = clamp(taps.st + taps.radius * p, taps.last.x, taps.last.y);
    float z = clamp(taps.z + dot(taps.slope, st - taps.st), 0.0, 1.0) - taps.bias;
    return textureLod(uShadowCompare, vec3(st, z), 0.0);
}
// [end:tap]

// [begin:layouts]
#if defined(JITTER_ROTATION)
// Golden-angle spiral, outermost first: each tap a turn of the one before.
float litOfEight(Taps taps, int chunk) {
    const float goldenAngle = 2.399963230;
    float first = float(8 * chunk);
    vec2 start = vec2(cos(goldenAngle * first), sin(goldenAngle * first));
    vec2 p = vec2(start.x * taps.turn.x - start.y * taps.turn.y, start.x * taps.turn.y + start.y * taps.turn.x);
    const vec2 turn = vec2(-0.737368878, 0.675490294);
    float lit = 0.0;
    for (int i = 0; i < 8; ++i) {
        lit += litTap(taps, sqrt(1.0 - (first + float(i) + 0.5) / float(uSamples)) * p);
        p = vec2(p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x);
    }
    return lit;
}
#elif defined(JITTER_LECTURE)
// As the lecture has it: a filtered look-up brings two samples. Slices are read at their centres; k / slices lies between two.
float litOfEight(Taps taps, int chunk) {
    vec3 size = vec3(textureSize(uJitter, 0));
    float lit = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 p = textureLod(uJitter, vec3(gl_FragCoord.xy / size.xy, (float(4 * chunk + i) + 0.5) / size.z), 0.0);
        lit += litTap(taps, p.xy) + litTap(taps, p.zw);
    }
    return lit;
}
#elif defined(JITTER_SNORM8)
float litOfEight(Taps taps, int chunk) {
    float lit = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec4 p = texelFetch(uJitter, ivec3(taps.column, 4 * chunk + i), 0);
        lit += litTap(taps, p.xy) + litTap(taps, p.zw);
    }
    return lit;
}
#elif defined(JITTER_PACKED16)
float litOfFour(Taps taps, uvec4 words) {
    // Shifted up and down again, the sign comes along.
    vec4 x = vec4(ivec4(words << 16) >> 16) / 32767.0, y = vec4(ivec4(words) >> 16) / 32767.0;
    return litTap(taps, vec2(x.x, y.x)) + litTap(taps, vec2(x.y, y.y)) + litTap(taps, vec2(x.z, y.z)) +
           litTap(taps, vec2(x.w, y.w));
}
float litOfEight(Taps taps, int chunk) {
    return litOfFour(taps, texelFetch(uJitter, ivec3(taps.column, 2 * chunk), 0)) +
           litOfFour(taps, texelFetch(uJitter, ivec3(taps.column, 2 * chunk + 1), 0));
}
#else
float litOfTwo(Taps taps, uint word) {
    vec4 p = vec4(ivec4(word << 24, word << 16, word << 8, word) >> 24) * (1.0 / 127.0);
    return litTap(taps, p.xy) + litTap(taps, p.zw);
}
// One look-up, eight tests.
float litOfEight(Taps taps, int chunk) {
    uvec4 words = texelFetch(uJitter, ivec3(taps.column, chunk), 0);
    return litOfTwo(taps, words.x) + litOfTwo(taps, words.y) + litOfTwo(taps, words.z) + litOfTwo(taps, words.w);
}
#endif
// [end:layouts]

// [begin:loop]
// Tests chunks [first, end) of eight. A CPU rasteriser ends a loop where its condition leaves no pixel of a group, and asks at the
// end of the body only: so it runs once at least, and a condition at its beginning would run it once too often. Pixels that want no
// test look at one and the same texel then: it is the fetch of texels here and there that takes the time.
float litOfChunks(Taps taps, int first, int end) {
    bool wanted = first < end;
    if (!wanted) {
        taps.st = vec2(0.5);
        taps.radius = vec2(0.0);
    }
    int chunk = wanted ? first : 0;
    float lit = 0.0;
    do lit += litOfEight(taps, chunk);
    while (++chunk < end);
    return wanted ? lit : 0.0;
}
// [end:loop]
