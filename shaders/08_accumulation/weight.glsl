// What a point of the light is worth at a texel.
uniform vec2 uUEdge;  // metres, in the receiver's plane: the texture's u edge, along x (so that a row has one y)
uniform vec2 uVEdge;
uniform vec2 uTexels;

// Metres from the receiver's corner.
vec2 pointOfTexel(vec2 fragCoord) {
    vec2 uv = fragCoord / uTexels;
    return uv.x * uUEdge + uv.y * uVEdge;
}

// [begin:weight]
// Of one light point at four texels (x, y) of a row: cos(theta_x) cos(theta_l) / r^2 times the area that the point stands for.
// On a plane cos(theta_x) is the light point's height over r; cos(theta_l) is the texel's height under the light's plane over r,
// the same for all points, and left to whoever needs more than ratios. lightPoint: foot of the perpendicular (x, y), height
// squared, area times height.
vec4 weight(vec4 lightPoint, vec4 x, float y) {
#ifdef EQUAL_WEIGHTS
    return vec4(lightPoint.w > 0.0 ? 1.0 : 0.0);
#else
    vec4 dx = x - lightPoint.x;
    float dy = y - lightPoint.y;
    vec4 r2 = dx * dx + (dy * dy + lightPoint.z);
    return lightPoint.w / (r2 * r2);
#endif
}
// [end:weight]
