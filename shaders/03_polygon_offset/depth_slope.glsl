// How fast depth changes over the map on the plane that a fragment lies on.
//
// Window depth is affine in the map's coordinates on a plane, even under perspective. So two numbers, dz/ds and dz/dt, say all, and
// they follow from the plane and the matrix without asking neighbours (Isidoro 2006 takes screen derivatives of a divided
// coordinate, which are noisy and wrong across edges).

const float steepestCosine = 0.0871557;  // 85 degrees: steeper than that a surface gets no light worth a bias
const float roundOff = 5.9604645e-8;     // 2^-24

struct Plane {
    vec3 normal;        // unit, geometric, on the light's side
    float uncertainty;  // largest error of the normal, radians
};

struct DepthSlope {
    vec2 value;      // dz/ds, dz/dt
    vec2 atMost;     // no less than their absolute values, whatever the normal's error
    float cosTheta;  // between normal and light
    float perMetre; // how much nearer to the light a metre along the normal is, compared with the plane below
};

// [begin:receiver-plane]
// The triangle's own plane: shading normals are smooth, and a bias from them misses facets. The pixel's neighbours lie on the
// same plane, so differences of positions span it; each is off by the rounding of the two positions.
// Calls dFdx: before any branch.
Plane receiverPlane(vec3 pWorld, vec3 nWorld, vec3 toLight) {
    vec3 dx = dFdx(pWorld), dy = dFdy(pWorld);
    vec3 span = cross(dx, dy);
    float area = length(span);
    float error = 8.0 * roundOff * max(max(abs(pWorld.x), abs(pWorld.y)), abs(pWorld.z));
    if (area == 0.0) return Plane(normalize(nWorld), 1.0);
    vec3 n = span / area;
    return Plane(dot(n, toLight) < 0.0 ? -n : n, error * (length(dx) + length(dy)) / area);
}
// [end:receiver-plane]

// [begin:depth-slope]
// gs, gt, gr: gradients of s/q, t/q, r/q in the world at this point. Along the light's ray s and t stay, so gs x gt points along
// it. On the plane gr = z_s gs + z_t gt + (something) n; crossing that out leaves the two slopes as ratios of volumes.
DepthSlope depthSlope(mat4 textureFromWorld, float q, vec3 str, Plane plane) {
    mat4 rows = transpose(textureFromWorld);
    vec3 gs = (rows[0].xyz - str.x * rows[3].xyz) / q;
    vec3 gt = (rows[1].xyz - str.y * rows[3].xyz) / q;
    vec3 gr = (rows[2].xyz - str.z * rows[3].xyz) / q;
    vec3 ray = cross(gs, gt), s = cross(gr, gt), t = cross(gs, gr);
    float volume = dot(plane.normal, ray), rayLength = length(ray);
    vec2 volumes = vec2(dot(plane.normal, s), dot(plane.normal, t));

    DepthSlope slope;
    slope.cosTheta = abs(volume) / rayLength;
    float surely = rayLength * max(slope.cosTheta - plane.uncertainty, steepestCosine);
    slope.atMost = (abs(volumes) + plane.uncertainty * vec2(length(s), length(t))) / surely;
    slope.value = clamp(volumes / volume, -slope.atMost, slope.atMost);
    slope.perMetre = abs(dot(plane.normal, gr) - dot(slope.value, vec2(dot(plane.normal, gs), dot(plane.normal, gt))));
    return slope;
}
// [end:depth-slope]
