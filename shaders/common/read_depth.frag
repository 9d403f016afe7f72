// Copies a depth texture, bit for bit, into an integer target: OpenGL ES cannot read depth back, nor can every driver
// render to float, but integer targets are everywhere.
uniform sampler2D uDepth;
layout(location = 0) out uvec4 fragBits;

void main() {
    fragBits = uvec4(floatBitsToUint(texelFetch(uDepth, ivec2(gl_FragCoord.xy), 0).r), 0u, 0u, 0u);
}
