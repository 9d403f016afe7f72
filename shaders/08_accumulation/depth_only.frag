// Depth alone; the material is read only so that what draws a scene can set it.
#include "common/material.glsl"

void main() {
}
