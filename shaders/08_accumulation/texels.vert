// Rectangles of texels, four in a row to a fragment: all of a texture, or the blocks that a shadow may reach.
layout(location = 0) in vec2 aTexel;

uniform vec2 uFragments;  // across and down

void main() {
    vec2 fragment = vec2(ceil(0.25 * aTexel.x), aTexel.y);
    // In the middle of the depth range: fragments of depth 1 pass a GL_LESS test, those of depth 0 fail.
    gl_Position = vec4(2.0 * fragment / uFragments - 1.0, 0.0, 1.0);
}
