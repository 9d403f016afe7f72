// The map as a picture: window depth as stored, or metres along the light's axis.
uniform sampler2D uShadowMap;
uniform ivec2 uPictureSize;
uniform bool uLinear;
uniform bool uOrthographic;
uniform bool uReversed;
uniform vec2 uNearFar;  // metres

out vec4 outColor;

// [begin:linear-depth]
// Inverts z = far (d - near) / (d (far - near)): perspective spends its depths near the light.
float metres(float z) {
    float near = uNearFar.x, far = uNearFar.y;
    float share = uReversed ? 1.0 - z : z;
    return uOrthographic ? near + share * (far - near) : far * near / (far - share * (far - near));
}
// [end:linear-depth]

void main() {
    // The largest centred square of the picture shows the map, each pixel the texel its centre falls in.
    float side = float(min(uPictureSize.x, uPictureSize.y));
    vec2 uv = (gl_FragCoord.xy - 0.5 * vec2(uPictureSize)) / side + 0.5;
    ivec2 mapSize = textureSize(uShadowMap, 0);
    ivec2 texel = ivec2(floor(uv * vec2(mapSize)));
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, mapSize))) {
        outColor = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    float z = texelFetch(uShadowMap, texel, 0).r;
    outColor = vec4(vec3(uLinear ? metres(z) : z), 1.0);
}
