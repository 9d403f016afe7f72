// Pass 2: the camera's picture. Each vertex goes to the camera, and to the light as in pass 1.
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aUv;

uniform mat4 uClipFromWorld;
uniform mat4 uShadowTextureFromWorld;

out vec3 pWorld;
out vec3 nWorld;
out vec2 vUv;
out vec4 strq;

void main() {
    pWorld = aPosition;
    nWorld = aNormal;
    vUv = aUv;
    strq = uShadowTextureFromWorld * vec4(aPosition, 1.0);
    gl_Position = uClipFromWorld * vec4(aPosition, 1.0);
}
