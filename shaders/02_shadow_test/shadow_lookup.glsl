// The shadow map, seen from a surface point: where the point falls on it, and what lies there.
uniform sampler2D uShadowMap;  // read as numbers; the comparison is this chapter's
uniform float uFarther;        // 1: larger depths are farther from the light; -1: reversed-Z
uniform bool uOutsideLit;      // S of a point that the map doesn't cover
uniform bool uBehindLit;       // S of a point behind the light

// [begin:projective-lookup]
// (s, t) on the map and r, the point's own depth. False when the map cannot tell, and `decided` is S by decree.
bool projectOnMap(vec4 strq, out vec3 str, out float decided) {
    // Behind the light, where q <= 0. Dividing anyway mirrors the scene through the light: "negative projection" puts a
    // second, false, shadow there.
    str = vec3(0.0);
    decided = uBehindLit ? 1.0 : 0.0;
    if (strq.w <= 0.0) return false;
    float perQ = 1.0 / strq.w;
    str = vec3(strq.x * perQ, strq.y * perQ, strq.z * perQ);  // s/q, t/q, r/q
    decided = uOutsideLit ? 1.0 : 0.0;
    bool beyondFar = uFarther > 0.0 ? str.z > 1.0 : str.z < 0.0;
    return !beyondFar && all(greaterThanEqual(str.xy, vec2(0.0))) && all(lessThan(str.xy, vec2(1.0)));
}
// [end:projective-lookup]

// [begin:discretise]
// (x_light, y_light) -> (x_shadow, y_shadow): texel i covers [i, i + 1) / size, and its depth was taken at its centre.
ivec2 texelAt(vec2 st) {
    ivec2 size = textureSize(uShadowMap, 0);
    return min(ivec2(st * vec2(size)), size - 1);
}

float nearestDepth(ivec2 texel) {
    return texelFetch(uShadowMap, texel, 0).r;
}
// [end:discretise]
