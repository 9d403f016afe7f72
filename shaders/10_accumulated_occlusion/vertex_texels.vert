// The picture, each vertex with its texel of what was added up.
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aUv;

uniform mat4 uClipFromWorld;
uniform sampler2D uAmbient;
uniform sampler2D uLightOfVertices;

out vec3 nWorld;
out vec2 vUv;
out vec4 vStored;
out vec4 vLight;

void main() {
    int width = textureSize(uAmbient, 0).x;
    ivec2 texel = ivec2(gl_VertexID % width, gl_VertexID / width);
    vStored = texelFetch(uAmbient, texel, 0);
    vLight = texelFetch(uLightOfVertices, texel, 0);
    nWorld = aNormal;
    vUv = aUv;
    gl_Position = uClipFromWorld * vec4(aPosition, 1.0);
}
