// Pass 1: the scene as the light sees it. Depth is all that is wanted, so a position is all that comes in.
layout(location = 0) in vec3 aPosition;

uniform mat4 uLightClipFromWorld;

// Chapter 03 peels a second layer with the same vertices: its depths must be the same bits.
invariant gl_Position;

void main() {
    gl_Position = uLightClipFromWorld * vec4(aPosition, 1.0);
}
