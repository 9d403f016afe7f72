// The shadow tests of a batch of maps, added to the sums of every receiver: a texel each.
uniform sampler2D uPositions;   // metres; w: 1, or 0 where there is no receiver
uniform sampler2D uNormals;     // shading normals
uniform sampler2D uFacets;      // normals of the triangles themselves
uniform sampler2D uSeen;        // the sums so far: V (n.l) l, and V (n.l)
uniform sampler2D uReceived;    // V (n.l) L, and (n.l)
uniform sampler2DArray uMaps;

uniform int uCount;             // maps in this batch
uniform vec4 uCones[BATCH / LEAF];  // a receiver with dot(n, xyz) <= w has none of LEAF neighbours above its horizon
uniform vec3 uCentre;           // of the sphere that every map shows, from edge to edge and from depth 0 to depth 1
uniform float uPerRadius;
uniform vec4 uRight[BATCH];     // xyz: along the rows of map k, unit
uniform vec4 uUp[BATCH];        // xyz: along its columns
uniform vec4 uRadiance[BATCH];  // of the sky where map k looks from
uniform float uMapSize;
uniform float uBiasPerSlope;
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
    vec3 q = (p.xyz - uCentre) * uPerRadius;  // -1 to 1 along every axis that a map can have
    float mapSize = uMapSize, perSlope = uBiasPerSlope, bias = uBias;  // what is read here is not read again N times
    for (int first = 0; first < uCount; first += LEAF) {
        // A skip as the bound of a loop: it ends where no pixel of the processor's group needs it. An `if` would run on.
        vec4 cone = uCones[first / LEAF];
        int end = dot(n, cone.xyz) > cone.w ? min(first + LEAF, uCount) : first;
        for (int k = first; k < end; ++k) {
            // Two axes of the map say all of it: the third one, their product, points to the sky.
            vec3 right = uRight[k].xyz, up = uUp[k].xyz, l = cross(right, up);
            float weight = dot(n, l), facing = dot(facet, l);
            if (weight <= horizonCosine) weight = 0.0;
            received.w += weight;

            vec2 at = (0.5 + 0.5 * vec2(dot(right, q), dot(up, q))) * mapSize;
            float z = 0.5 - 0.5 * dot(l, q);
            // Chapter 03's bound, S + Q + C. A map of the sky has no perspective, so the slope of a plane follows from its normal:
            // |dz/ds| + |dz/dt| = slope / facing. Everything is multiplied by `facing`, and there is nothing to divide by.
            vec2 slopes = vec2(dot(facet, right), dot(facet, up));
            float margin = perSlope * (abs(slopes.x) + abs(slopes.y));
#ifdef SOFT_EDGES
            weight *= facing > 0.0 ? openShare(k, at, z, facing, slopes / mapSize, margin) : 0.0;
#else
            float zMap = texelFetch(uMaps, ivec3(at, k), 0).r;
            bool lit = facing > 0.0 && (z - zMap - bias) * facing <= margin;
            if (!lit) weight = 0.0;
#endif
            seen += weight * vec4(l, 1.0);
#ifdef COUNT_WORK
            received.rgb += vec3(1.0);
#else
            received.rgb += weight * uRadiance[k].rgb;
#endif
        }
    }
    // [end:accumulate]
    outSeen = seen;
    outReceived = received;
}
