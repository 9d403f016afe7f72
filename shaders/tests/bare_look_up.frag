// As many look-ups of shadow maps as there can be, and nothing else: what chapter 10 is timed against.
uniform sampler2D uPositions;
uniform sampler2DArray uMaps;
uniform int uCount;
uniform vec4 uAcross[BATCH];
uniform vec4 uUp[BATCH];
uniform vec4 uDepth[BATCH];

layout(location = 0) out vec4 outSeen;
layout(location = 1) out vec4 outUnused;

void main() {
    vec4 p = texelFetch(uPositions, ivec2(gl_FragCoord.xy), 0);
    float seen = 0.0;
    for (int k = 0; k < uCount; ++k) {
        ivec3 texel = ivec3(dot(uAcross[k], p), dot(uUp[k], p), k);
        seen += dot(uDepth[k], p) > texelFetch(uMaps, texel, 0).r ? 0.0 : 1.0;
    }
    outSeen = outUnused = vec4(seen);
}
