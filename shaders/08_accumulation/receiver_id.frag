// Which receiver the camera sees in a pixel; the material is read only so that what draws a scene can set it.
#include "common/material.glsl"

uniform vec4 uId;

out vec4 outId;

void main() {
    outId = uId;
}
