// A picture that was made elsewhere, texel by texel.
uniform sampler2D uPicture;

out vec4 outColor;

void main() { outColor = vec4(texelFetch(uPicture, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }
