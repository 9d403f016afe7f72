// The irradiance from a polygonal light with nothing in between, in closed form (Lambert 1760; Baum, Rushmeier & Winget 1989).
#include "common/light.glsl"

uniform sampler2D uLightTriangles;  // a row for each triangle, three corners
uniform int uTriangleCount;               // 0: not an area light
uniform vec3 uRadiance;                   // of an area light

// The contribution of one edge, both ends relative to the receiver.
float edgeOf(vec3 n, vec3 a, vec3 b) {
    vec3 c = cross(a, b - a);
    float l = length(c);
    return l > 0.0 ? atan(l, dot(a, b)) * dot(n, c) / l : 0.0;
}

// Edges are cut at the receiver's horizon, and the gap between the two cuts is closed along it.
float triangleIrradiance(vec3 n, vec3 corners[3]) {
    float sum = 0.0;
    vec3 leaves = vec3(0.0), enters = vec3(0.0);
    bool cut = false;
    for (int i = 0; i < 3; ++i) {
        vec3 a = corners[i], b = corners[i == 2 ? 0 : i + 1];
        float above = dot(n, a), next = dot(n, b);
        vec3 crossing = a + (b - a) * (above / (above - next));
        if (above >= 0.0 && next >= 0.0) sum += edgeOf(n, a, b);
        if (above >= 0.0 && next < 0.0) {
            sum += edgeOf(n, a, crossing);
            leaves = crossing;
            cut = true;
        }
        if (above < 0.0 && next >= 0.0) {
            sum += edgeOf(n, crossing, b);
            enters = crossing;
        }
    }
    return sum + (cut ? edgeOf(n, leaves, enters) : 0.0);
}

// Unoccluded irradiance at x on a surface with unit normal n, from whatever light there is.
vec3 unoccludedIrradiance(vec3 x, vec3 n) {
    if (uTriangleCount == 0) return facingIrradiance(x) * max(dot(n, directionToLight(x)), 0.0);
    if (dot(uLightDirection, x - uLightPosition) <= 0.0) return vec3(0.0);
    float sum = 0.0;
    for (int i = 0; i < uTriangleCount; ++i) {
        vec3 corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = texelFetch(uLightTriangles, ivec2(k, i), 0).xyz - x;
        sum += triangleIrradiance(n, corners);
    }
    return uRadiance * 0.5 * abs(sum);
}
