// The picture. With STORED each vertex brings what was baked into it.
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aUv;
#ifdef STORED
layout(location = 3) in vec4 aStored;  // bent vector, ambient visibility
layout(location = 4) in vec4 aLight;   // radiance that arrives, work
#endif

uniform mat4 uClipFromWorld;

out vec3 nWorld;
out vec2 vUv;
out vec4 vStored;
out vec4 vLight;

void main() {
    nWorld = aNormal;
    vUv = aUv;
#ifdef STORED
    vStored = aStored;
    vLight = aLight;
#else
    vStored = vec4(0.0);
    vLight = vec4(0.0);
#endif
    gl_Position = uClipFromWorld * vec4(aPosition, 1.0);
}
