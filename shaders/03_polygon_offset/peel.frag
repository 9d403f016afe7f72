// The second layer: what the light would see if the first were taken away (Everitt 2001).
uniform sampler2D uFirstLayer;
uniform float uFarther;
uniform vec2 uQuantum;

void main() {
    float first = texelFetch(uFirstLayer, ivec2(gl_FragCoord.xy), 0).r;
    // The first layer itself comes by again, rounded to the format: one quantum behind it is still the same surface.
    if (uFarther * (gl_FragCoord.z - first) <= uQuantum.x + uQuantum.y * first) discard;
}
