// What a look-up has to know of the surface that a pixel sees: where it is, and which way it faces.
#include "common/material.glsl"

in vec3 pWorld;
in vec3 nWorld;

layout(location = 0) out vec4 outPosition;  // w: 1, a surface
layout(location = 1) out vec4 outNormal;    // shading normal, on the side looked at
layout(location = 2) out vec4 outFacet;     // the triangle's own

// [begin:surface]
void main() {
    outPosition = vec4(pWorld, 1.0);
    outNormal = vec4(facingNormal(nWorld), 0.0);
    // Right and up along the picture, crossed, point to whoever looks at it.
    outFacet = vec4(normalize(cross(dFdx(pWorld), dFdy(pWorld))), 0.0);
}
// [end:surface]
