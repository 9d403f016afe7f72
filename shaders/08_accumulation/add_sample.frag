// Adds one hard shadow image to the sums: what its light point gives past the occluders, and what it would give without them.
#include "08_accumulation/weight.glsl"

uniform sampler2D uCovered;
uniform vec4 uLightPoint;

layout(location = 0) out vec4 outSums;

// [begin:add]
void main() {
    vec2 p = pointOfTexel(gl_FragCoord.xy);
    float f = weight(uLightPoint, vec4(p.x), p.y).x;
    float V = 1.0 - texelFetch(uCovered, ivec2(gl_FragCoord.xy), 0).r;
    outSums = vec4(V * f, f, 0.0, 0.0);
}
// [end:add]
