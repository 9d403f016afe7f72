// How much of the sky around a direction is open, from the one map of that direction.
uniform float uCell;          // texels for each unit of depth: radius of the circle that halves what a direction stands for

// [begin:soft-edges]
// A direction stands for a cap of the sky. An occluder at the height h above the receiver (a difference of depths) hides a part of the
// cap if it lies within a disk on the map, as large as h is. So two rings of four look-ups, each for occluders of one height:
const vec2 ringHeights = vec2(1.0 / 28.0, 3.0 / 28.0);

// 1 if at `at + offset` something is above the receiver's tangent plane, which is as tilted there as here. Adds to `occluders` what is
// found: how many, and the sum of their heights.
float blockedAt(int k, vec2 at, vec2 offset, float z, float facing, vec2 tilt, float margin, inout vec2 occluders) {
    ivec2 last = textureSize(uMaps, 0).xy - 1;
    float height = z - texelFetch(uMaps, ivec3(clamp(ivec2(at + offset), ivec2(0), last), k), 0).r;
    float blocked = (height - uBias) * facing + dot(tilt, offset) > margin ? 1.0 : 0.0;
    occluders += blocked * vec2(1.0, height);
    return blocked;
}

float blockedAround(int k, vec2 at, vec2 offset, float z, float facing, vec2 tilt, float margin, inout vec2 occluders) {
    vec2 across = vec2(-offset.y, offset.x);
    return 0.25 * (blockedAt(k, at, offset, z, facing, tilt, margin, occluders) +
                   blockedAt(k, at, across, z, facing, tilt, margin, occluders) +
                   blockedAt(k, at, -offset, z, facing, tilt, margin, occluders) +
                   blockedAt(k, at, -across, z, facing, tilt, margin, occluders));
}

// The open share of the cap: of the rings within the disk of the mean occluder, each by its area. `tilt`: of the surface, depth a texel
// (times `facing`).
float openShare(int k, vec2 at, float z, float facing, vec2 tilt, float margin) {
    vec2 occluders = vec2(0.0);
    vec2 inner = uCell * ringHeights.x * vec2(0.9792, 0.2028), outer = uCell * ringHeights.y * vec2(0.5491, 0.8358);
    vec3 blocked = vec3(blockedAt(k, at, vec2(0.0), z, facing, tilt, margin, occluders),
                        blockedAround(k, at, inner, z, facing, tilt, margin, occluders),
                        blockedAround(k, at, outer, z, facing, tilt, margin, occluders));
    float height = occluders.x > 0.0 ? occluders.y / occluders.x : 0.0;
    vec3 area = vec3(0.25, height >= ringHeights.x ? 1.0 : 0.0, height >= ringHeights.y ? 9.0 : 0.0);
    return 1.0 - dot(area, blocked) / dot(area, vec3(1.0));
}
// [end:soft-edges]
