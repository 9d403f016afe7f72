// The depth pass of the unit tests.
layout(location = 0) in vec3 aPosition;
uniform mat4 uClipFromWorld;

void main() { gl_Position = uClipFromWorld * vec4(aPosition, 1.0); }
