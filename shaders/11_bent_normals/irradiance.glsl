// What a sky gives to a plane: three ways to keep it. Twins of sh_irradiance.h and irradiance_map.h; a test holds them together.
const float pi = 3.14159265358979;

#ifdef HARMONICS
uniform vec4 uHarmonics[9];
// [begin:sh]
// Nine numbers a channel. Behind a small lamp the polynomial falls below zero.
vec3 skyIrradiance(vec3 n) {
    vec4 E = uHarmonics[0] + uHarmonics[1] * n.y + uHarmonics[2] * n.z + uHarmonics[3] * n.x + uHarmonics[4] * (n.x * n.y) +
             uHarmonics[5] * (n.y * n.z) + uHarmonics[6] * (3.0 * n.z * n.z - 1.0) + uHarmonics[7] * (n.x * n.z) +
             uHarmonics[8] * (n.x * n.x - n.y * n.y);
    return max(E.rgb, vec3(0.0));
}
// [end:sh]
#endif

#ifdef MAP
uniform sampler2D uIrradianceMap;  // row 0 is the upper pole, the last one the lower; column 0 looks along -z
// [begin:map]
vec3 irradianceTexel(int column, int row) {
    return texelFetch(uIrradianceMap, ivec2(column % textureSize(uIrradianceMap, 0).x, row), 0).rgb;
}

// Bilinear by hand: float textures cannot be filtered everywhere. At the poles all columns are equal, whatever atan makes of 0, 0.
vec3 skyIrradiance(vec3 n) {
    vec2 size = vec2(textureSize(uIrradianceMap, 0));
    float across = length(n.xz);
    float turn = across > 0.0 ? fract(atan(n.x, -n.z) / (2.0 * pi)) : 0.0;
    vec2 p = vec2(turn * size.x, atan(across, n.y) / pi * (size.y - 1.0));
    vec2 corner = min(floor(p), size - vec2(1.0, 2.0)), t = p - corner;
    int column = int(corner.x), row = int(corner.y);
    vec3 above = mix(irradianceTexel(column, row), irradianceTexel(column + 1, row), t.x);
    vec3 below = mix(irradianceTexel(column, row + 1), irradianceTexel(column + 1, row + 1), t.x);
    return mix(above, below, t.y);
}
// [end:map]
#endif

#ifdef LINEAR
uniform vec3 uMean;
uniform mat3 uGradient;
// [begin:pair]
// The sky is uMean + uGradient w. Then no look-up errs: whatever hides it, A and the bent vector say all about the open part.
vec3 pairIrradiance(vec4 seen) { return max(pi * (seen.w * uMean + uGradient * seen.xyz), vec3(0.0)); }
// [end:pair]
#endif
