// What the eye gets from a surface that light `irradiance` arrives at: the paper's surfaces are diffuse.
#include "common/material.glsl"

uniform vec3 uAmbientRadiance;
uniform int uView;  // 0 color, 1 visibility, 2 irradiance, 3 work

vec3 diffuseRadiance(vec3 irradiance, vec2 uv) {
    vec3 diffuse = materialDiffuse(uv);
    return materialEmission() + diffuse * (uAmbientRadiance + irradiance / 3.14159265358979);
}
