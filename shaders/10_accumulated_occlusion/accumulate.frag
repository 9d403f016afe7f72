// The shadow tests of a batch of maps, added to the sums of every receiver: a texel each.
uniform sampler2D uPositions;   // metres; w: 1, or 0 where there is no receiver
uniform sampler2D uNormals;     // shading normals
uniform sampler2D uFacets;      // normals of the triangles themselves
uniform sampler2D uSeen;        // the sums so far: V (n.l) l, and V (n.l)
uniform sampler2D uReceived;    // V (n.l) L, and (n.l)
uniform sampler2DArray uMaps;

uniform int uCount;             // maps in this batch
uniform vec4 uCone;             // a receiver with dot(n, xyz) <= w has none of them above its horizon
uniform vec4 uAcross[BATCH];    // texels across map k = dot(uAcross[k], (p, 1))
uniform vec4 uUp[BATCH];
uniform vec4 uToSky[BATCH];     // xyz: the direction, unit; w: depth 0 lies at l.p = w
uniform vec4 uRadiance[BATCH];  // of the sky there
uniform float uDepthPerMetre;
uniform float uBiasPerSlope;    // slopes in texels a metre: of uAcross, uUp
uniform float uBias;

layout(location = 0) out vec4 outSeen;
layout(location = 1) out vec4 outReceived;

const float horizonCosine = 0.02;  // as in direction_batches.h

#ifdef SOFT_EDGES
#include "10_accumulated_occlusion/soft_edges.glsl"
#endif

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 p = texelFetch(uPositions, texel, 0);
    vec3 n = texelFetch(uNormals, texel, 0).xyz, facet = texelFetch(uFacets, texel, 0).xyz;
    vec4 seen = texelFetch(uSeen, texel, 0), received = texelFetch(uReceived, texel, 0);
    // [begin:accumulate]
    // A skip as the bound of a loop: it ends where no pixel of the processor's group needs it. An `if` would run on.
    int count = dot(n, uCone.xyz) > uCone.w ? uCount : 0;
    for (int k = 0; k < count; ++k) {
        vec3 l = uToSky[k].xyz;
        float weight = dot(n, l), facing = dot(facet, l);
        if (weight <= horizonCosine) weight = 0.0;
        received.w += weight;

        // Chapter 03's bound, S + Q + C. A map of the sky has no perspective, so the slope of a plane follows from its normal:
        // |dz/ds| + |dz/dt| = slope / facing. Everything is multiplied by `facing`, and there is nothing to divide by.
        float slope = abs(dot(facet, uAcross[k].xyz)) + abs(dot(facet, uUp[k].xyz));
        float z = (uToSky[k].w - dot(l, p.xyz)) * uDepthPerMetre;
#ifdef SOFT_EDGES
        vec2 at = vec2(dot(uAcross[k], p), dot(uUp[k], p)), slopes = vec2(dot(facet, uAcross[k].xyz), dot(facet, uUp[k].xyz));
        weight *= facing > 0.0 ? openShare(k, at, z, facing, slopes, uBiasPerSlope * slope) : 0.0;
#else
        float zMap = texelFetch(uMaps, ivec3(dot(uAcross[k], p), dot(uUp[k], p), k), 0).r;
        bool lit = facing > 0.0 && (z - zMap - uBias) * facing <= uBiasPerSlope * slope;
        if (!lit) weight = 0.0;
#endif
        seen += weight * vec4(l, 1.0);
#ifdef COUNT_WORK
        received.rgb += vec3(1.0);
#else
        received.rgb += weight * uRadiance[k].rgb;
#endif
    }
    // [end:accumulate]
    outSeen = seen;
    outReceived = received;
}
