// What a look-up has to know of the surface that a pixel sees: where it is, and which way it faces.
#include "common/material.glsl"

in vec3 pWorld;
in vec3 nWorld;

layout(location = 0) out vec4 outPosition;  // w: 1, a surface
layout(location = 1) out vec4 outNormal;    // shading normal, on the side looked at
layout(location = 2) out vec4 outFacet;     // the triangle's own; w: tangent of the tilt of its neighbours

// [begin:surface]
void main() {
    // Right and up along the picture, crossed, point to whoever looks at it.
    vec3 facet = normalize(cross(dFdx(pWorld), dFdy(pWorld)));
    vec3 n = facingNormal(nWorld);
    outPosition = vec4(pWorld, 1.0);
    outNormal = vec4(n, 0.0);
    outFacet = vec4(facet, length(cross(facet, n)) / max(dot(facet, n), 0.1));
}
// [end:surface]
