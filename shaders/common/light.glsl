// One light, and what it sends to a point when nothing is in between. Twin of common/scene/light.h: a test compares the two.
// The uniforms are set by setLight in common/scene/gpu_light.h.

const int lightPoint = 0;
const int lightSpot = 1;
const int lightDirectional = 2;
const int lightArea = 3;  // taken as a point at its centre

uniform int uLightType;
uniform vec3 uLightPosition;
uniform vec3 uLightDirection;  // unit, the way the light travels
uniform vec3 uLightEmission;   // point, spot: W/sr; directional: W/m^2; area: radiance times area, W/sr
uniform vec2 uLightCosines;    // spot: cosines of the inner and the outer half angle

// Of any length.
vec3 towardsLight(vec3 x) {
    return uLightType == lightDirectional ? -uLightDirection : uLightPosition - x;
}

// Floats far from their origin may have a surface where the light is: it has no direction there, and sends nothing.
vec3 directionToLight(vec3 x) {
    vec3 toLight = towardsLight(x);
    bool none = uLightType == lightDirectional || !(dot(toLight, toLight) > 0.0);
    return none ? -uLightDirection : normalize(toLight);
}

// Unoccluded irradiance on a plane at x that faces the light.
vec3 facingIrradiance(vec3 x) {
    if (uLightType == lightDirectional) return uLightEmission;
    vec3 toLight = uLightPosition - x;
    float along = dot(uLightDirection, -normalize(toLight));
    float strength = 1.0;
    if (uLightType == lightSpot) {
        float ramp = clamp((along - uLightCosines.y) / max(uLightCosines.x - uLightCosines.y, 1e-6), 0.0, 1.0);
        strength = ramp * ramp;
    } else if (uLightType == lightArea) {
        strength = max(along, 0.0);
    }
    float squared = dot(toLight, toLight);
    return squared > 0.0 ? uLightEmission * strength / squared : vec3(0.0);
}
