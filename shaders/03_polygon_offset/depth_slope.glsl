// How fast depth changes over the map on the plane that a fragment lies on: dz/ds and dz/dt.
//
// Window depth is affine in the map's coordinates on a plane, even under perspective: two numbers say all. Isidoro (2006)
// takes them from screen derivatives of (s/q, t/q, r/q), which bend with perspective and are noisy after the division. Here
// (s, t, r, q) is differentiated before it is divided: that is linear on the plane, so a difference between neighbouring
// pixels is a step within the plane, exactly, however long.

uniform float uSteepest;  // |dz/ds| + |dz/dt| of a plane at 85 degrees to the light, times q: beyond, light is too faint to matter

struct DepthSlope {
    vec2 value;    // dz/ds, dz/dt
    float atMost;  // no less than |dz/ds| + |dz/dt|, whatever was rounded
};

// [begin:depth-slope]
DepthSlope depthSlope(vec4 pShadow, vec3 str, vec4 dx, vec4 dy, float perQ) {
    // Steps on the map, times q: the derivative of str = strq.xyz / q in the directions dx and dy.
    vec3 a = dx.xyz - str * dx.w;
    vec3 b = dy.xyz - str * dy.w;
    // a.z = z_s a.x + z_t a.y, b.z likewise: two equations, by Cramer's rule.
    float volume = a.x * b.y - a.y * b.x;
    vec2 volumes = vec2(a.z * b.y - a.y * b.z, a.x * b.z - a.z * b.x);
    // Each component of a and b is off by the rounding of four numbers of size q or less, each after four operations.
    float error = 16.0 * 5.9604645e-8 * pShadow.w;
    vec3 sizes = abs(a) + abs(b);
    float surely = abs(volume) - error * (sizes.x + sizes.y);
    float unsure = error * (sizes.x + sizes.y + 2.0 * sizes.z);

    DepthSlope slope;
    float steepest = uSteepest * perQ, sum = abs(volumes.x) + abs(volumes.y) + unsure;
    slope.atMost = sum < steepest * surely ? sum / surely : steepest;
    slope.value = volume == 0.0 ? vec2(0.0) : volumes / volume;
    slope.value *= min(1.0, slope.atMost / max(abs(slope.value.x) + abs(slope.value.y), 1e-30));
    return slope;
}
// [end:depth-slope]
