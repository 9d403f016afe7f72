// Solution 1: the sky is a hemisphere over an endless plain, and a point sees what its own surface leaves of it.
// [begin:hemisphere]
const vec3 up = vec3(0.0, 1.0, 0.0);

// n.up is the cosine of the tilt; from 1 for what lies flat to 0 for what faces down.
float hemisphereTerm(vec3 n) {
#ifdef UNIFORM_WEIGHTING
    return 1.0 - acos(clamp(dot(n, up), -1.0, 1.0)) / 3.14159265358979;
#else
    return 0.5 * (1.0 + dot(n, up));
#endif
}
// [end:hemisphere]
