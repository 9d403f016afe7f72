// The camera's picture. With STORED each vertex brings what it sees of the sky.
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aUv;
#ifdef STORED
layout(location = 3) in vec4 aSeen;
out vec4 vSeen;
#endif

uniform mat4 uClipFromWorld;

out vec3 pWorld;
out vec3 nWorld;
out vec2 vUv;

void main() {
    pWorld = aPosition;
    nWorld = aNormal;
    vUv = aUv;
#ifdef STORED
    vSeen = aSeen;
#endif
    gl_Position = uClipFromWorld * vec4(aPosition, 1.0);
}
