// The camera's picture. Where a receiver is drawn over the scene, its depths must be the scene's to the bit.
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aUv;

uniform mat4 uClipFromWorld;

out vec3 pWorld;
out vec3 nWorld;
out vec2 vUv;

invariant gl_Position;

void main() {
    pWorld = aPosition;
    nWorld = aNormal;
    vUv = aUv;
    gl_Position = uClipFromWorld * vec4(aPosition, 1.0);
}
