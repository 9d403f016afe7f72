// Surfaces that are no receivers: curved, small, or --method shadow-maps. Light in closed form, shadows (if any) from the sums of
// many shadow maps, pixel by pixel.
#include "08_accumulation/diffuse.glsl"
#include "08_accumulation/lambert.glsl"

in vec3 pWorld;
in vec3 nWorld;
in vec2 vUv;

uniform sampler2D uMapSums;
uniform bool uShadowed;
uniform bool uFirstLight;  // adds emission and ambient term; the others only their light

out vec4 outColor;

void main() {
    vec3 n = facingNormal(nWorld);
    vec3 irradiance = unoccludedIrradiance(pWorld, n);
    vec2 sums = texelFetch(uMapSums, ivec2(gl_FragCoord.xy), 0).rg;
    bool arrives = dot(irradiance, vec3(1.0)) > 0.0;
    float V = !arrives ? 0.0 : !uShadowed ? 1.0 : sums.g > 0.0 ? sums.r / sums.g : 0.0;
    vec3 radiance = uFirstLight ? diffuseRadiance(V * irradiance, vUv) : materialDiffuse(vUv) * V * irradiance / 3.14159265358979;
    vec3 value = uView == 0 ? radiance : uView == 2 ? V * irradiance : vec3(uView == 1 ? V : 0.3 * V);
    outColor = vec4(value, 1.0);
}
