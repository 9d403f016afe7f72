// Rectangles of texels; all of a texture, or the blocks that a shadow may reach.
layout(location = 0) in vec2 aTexel;

uniform vec2 uTextureSize;

void main() {
    // In the middle of the depth range: texels of depth 1 pass a GL_LESS test, those of depth 0 fail.
    gl_Position = vec4(2.0 * aTexel / uTextureSize - 1.0, 0.0, 1.0);
}
